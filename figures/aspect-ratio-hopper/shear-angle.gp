# title: Angle of the shear band, and the heap
# counterpart: A00 Figs 5.18 and 5.17
# needs: angles.csv heaps.csv
# caption: Left: angle from the horizontal of the line through the places where the mean speed of a row of cells falls below 30 % of the fastest, by time after the opening; one point per run. Dashes: the source's 90 and 55 degrees. Right: height of the heap in the chamber at 1.4 s, with the 95 % interval over replicates.
width = 17; height = 6.6
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
set multiplot
set tmargin at screen 1 - up(0.9)
set lmargin at screen across(1.6); set rmargin at screen across(8.2)
set key at screen 0.5,1 - up(0.12) center top maxrows 1
set xlabel 'time after the opening (s)'; set ylabel 'angle of the shear band (deg)'
set xrange [0.07:0.45]; set yrange [40:130]; set ytics 20
set arrow 1 from graph 0,first 90 to graph 1,first 90 nohead dt (6,3) lw 1 lc rgb thesis
set arrow 2 from graph 0,first 55 to graph 1,first 55 nohead dt (6,3) lw 1 lc rgb thesis
plot for [k=1:4] shape('angles', k) using ($3 + 0.006 * (k - 2.5)):4 with points pt mark[k] ps 0.7 lc rgb hue[k] title 'aspect '.k
unset label 999; unset key; unset arrow 1; unset arrow 2
set lmargin at screen across(10.0); set rmargin at screen across(16.7)
set xlabel 'x (cm)'; set ylabel 'height of the heap (cm)'
set xrange [-side:side]; set yrange [0:*]; set xtics auto; set ytics auto
plot for [k=1:4] shape('heaps', k) using 2:3:(spread($4)) with yerrorbars pt mark[k] ps 0.4 lw 0.8 lc rgb hue[k], \
     for [k=1:4] shape('heaps', k) using 2:3 with lines lw 1.3 lc rgb hue[k]
unset multiplot
