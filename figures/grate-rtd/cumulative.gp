# title: Share that has left
# counterpart: S12 Figs 4.10 and 4.12
# needs: curves.csv
# caption: F(t) of the four cases, samples every three minutes, with the 95 % interval. Shown to 120 min; a few of ceramic stay longer. The extrapolated experiment of the source passes 1 (its section 4.6.2); what never left here is a share of its own (table).
width = 12; height = 8
load style
array name[4] = ['forward clay', 'backward clay', 'backward wood', 'backward ceramic']
array hue[4] = [ours, thesis, frictional, experiment]
array shape[4] = [7, 5, 9, 13]
curve(k) = rows('curves', sprintf('$1 == "%s" && $2 == 3', name[k]))
set xrange [0:120]; set yrange [0:1.02]
set xlabel 'residence time (min)'; set ylabel 'F(t)'
set key bottom right
plot for [k=1:4] curve(k) using 4:($7 - spread($8)):($7 + spread($8)) with filledcurves fc rgb hue[k] fs transparent solid 0.12 noborder, \
     for [k=1:4] curve(k) using 4:7 with linespoints pt shape[k] ps 0.4 lw 1.3 lc rgb hue[k] title name[k]
