# title: Sampled every minute and every three
# counterpart: S12 Fig. 4.15
# needs: curves.csv
# caption: E(t) of the forward grate with clay from the same tracers, with the 95 % intervals.
width = 12; height = 7.5
load style
curve(m) = rows('curves', sprintf('$1 == "forward clay" && $2 == %d', m))
set lmargin at screen across(1.9)
set xrange [0:*]; set yrange [0:*]
set xlabel 'residence time (min)'; set ylabel 'E(t) (1/min)'
set key top right
plot curve(3) using (($3 + $4) / 2):($5 - spread($6)):($5 + spread($6)) with filledcurves fc rgb ours_pale fs transparent solid 0.7 noborder, \
     curve(1) using (($3 + $4) / 2):5:(spread($6)) with yerrorbars pt 6 ps 0.4 lw 0.7 lc rgb thesis title 'every minute', \
     curve(3) using (($3 + $4) / 2):5 with linespoints pt 7 ps 0.6 lw 1.5 lc rgb ours title 'every three minutes'
