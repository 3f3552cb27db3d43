# title: Residence times on the forward and on the backward grate
# counterpart: S12 Fig. 4.8
# needs: curves.csv cases.csv
# caption: Share of the fed clay that leaves per minute, from samples every three minutes, with its 95 % interval (block bootstrap); thin line: first passage with axial dispersion, fitted. Ticks on the axis: mean residence times. Shown to 80 min; a few stay longer. The source has its own curves in the figure alone.
width = 17; height = 8.4
load style
array name[2] = ['forward clay', 'backward clay']
array word[2] = ['forward', 'backward']
array hue[2] = [ours, thesis]
array pale[2] = [ours_pale, '#f6d9c6']
curve(k) = rows('curves', sprintf('$1 == "%s" && $2 == 3', name[k]))
set lmargin at screen across(1.9)
set xrange [0:80]; set yrange [0:*]
set xlabel 'residence time (min)'; set ylabel 'E(t) (1/min)'
set key top right
plot for [k=1:2] curve(k) using (($3 + $4) / 2):($5 - spread($6)):($5 + spread($6)) with filledcurves fc rgb pale[k] fs transparent solid 0.7 noborder, \
     for [k=1:2] curve(k) using (($3 + $4) / 2):11 with lines lw 0.9 dt (6,4) lc rgb hue[k], \
     for [k=1:2] curve(k) using (($3 + $4) / 2):5 with linespoints pt (k == 1 ? 7 : 5) ps 0.5 lw 1.5 lc rgb hue[k] title word[k], \
     for [k=1:2] rows('cases', sprintf('$1 == "%s"', name[k])) using 9:(0) with points pt 11 ps 1.1 lc rgb hue[k]
