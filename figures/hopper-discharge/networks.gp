# title: The fastest vibration of the flowing bed
# counterpart: none, our own measurement
# needs: networks.csv
# caption: Left: largest frequency of all closed contacts while the bed flows, by initial state, beside that of the sphere that its neighbours hold hardest. Right: the steps below which position Verlet and Numerov are stable on it.
width = 17; height = 8
load style
load tools.'/hopper-discharge/discharge.gpi'
set multiplot
set xlabel 'time after the opening, s'
set lmargin at screen across(1.7); set rmargin at screen 0.5 - across(0.1)
set ylabel 'frequency, rad/s'; set yrange [0:2400]
set key bottom left
plot rows('networks', '$4 > 0') using 2:4 with points pt 7 ps 0.35 lc rgb ink title 'whole bed', \
     rows('networks', '$4 > 0') using 2:5 with points pt 7 ps 0.35 lc rgb faint title 'one sphere alone'
unset label 999
set lmargin at screen 0.5 + across(1.7); set rmargin at screen 1 - across(0.35)
set ylabel 'limit of the step, ms'; set yrange [0.8:3]
set key bottom right
plot rows('networks', '$4 > 0') using 2:(1e3 * $8) with points pt 7 ps 0.35 lc rgb tints[2] title words[2], \
     rows('networks', '$4 > 0') using 2:(1e3 * $9) with points pt 7 ps 0.35 lc rgb tints[3] title words[3]
unset multiplot
