# title: One, two and five particles wide
# counterpart: S12 Fig. 4.14
# needs: wide.csv cases.csv
# caption: E(t) on the stepped forward grate (20° and 0°) with the particles made up for it, by the width of the channel in largest diameters, with 95 % intervals. Ticks on the axis: mean residence times.
width = 12; height = 8
load style
array wide[3] = [1, 2, 5]
array hue[3] = [ours, frictional, thesis]
curve(k) = rows('wide', sprintf('$1 == "width %d" && $2 == 3', wide[k]))
set xrange [0:*]; set yrange [0:*]
set xlabel 'residence time (min)'; set ylabel 'E(t) (1/min)'
set key top right
plot for [k=1:3] curve(k) using (($3 + $4) / 2):($5 - spread($6)):($5 + spread($6)) with filledcurves fc rgb hue[k] fs transparent solid 0.12 noborder, \
     for [k=1:3] curve(k) using (($3 + $4) / 2):5 with linespoints pt 5 + 2 * k ps 0.5 lw 1.4 lc rgb hue[k] title sprintf('%d wide', wide[k]), \
     for [k=1:3] rows('cases', sprintf('$1 == "width %d"', wide[k])) using 9:(0) with points pt 11 ps 1.1 lc rgb hue[k]
