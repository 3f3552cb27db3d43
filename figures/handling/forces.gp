# title: Forces on the conveyors while the irregular particle is carried and dropped
# counterpart: A00 Fig. 3.27(a) and (c)
# needs: forces.csv
# caption: Normal and tangential force of the particle on the upper and on the lower conveyor, recorded every 50 steps like in the source; first run. Its weight is 19.3 N. The curves of the source are only in its figure.
width = 17; height = 10.5
load style
belt(p) = rows('forces', sprintf('$1 == "%s" && $2 == "fiftieth"', p))
set multiplot
set xrange [0:*]
set lmargin at screen across(1.9)
set tmargin at screen 1 - up(0.8); set bmargin at screen up(6.0)
set key at screen across(1.9),1 - up(0.15) left top maxrows 1
set format x ''
set ylabel 'normal force (N)'
set yrange [0:*]
plot belt('upper') using 3:4 with lines lw 1 lc rgb thesis title 'upper conveyor', \
     belt('lower') using 3:4 with lines lw 1 lc rgb ours title 'lower conveyor'
unset label 999
set tmargin at screen up(5.6); set bmargin at screen up(1.55)
unset key
set format x '%g'; set xlabel 'time (s)'; set ylabel 'tangential force (N)'
plot belt('upper') using 3:5 with lines lw 1 lc rgb thesis, \
     belt('lower') using 3:5 with lines lw 1 lc rgb ours
unset multiplot
