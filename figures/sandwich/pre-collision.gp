# title: Where in a step the touch comes
# counterpart: S12 Fig. 3.12
# needs: approach.csv
# caption: Largest overlap at any step over the exact one, against the part of a step that is over before the touch (S12 3.57). 1.2 steps per contact, 0.5 m/s, no damping.
width = 12; height = 8
load style
load tools.'/sandwich/sandwich.gpi'
of(s) = rows('approach', sprintf('$1 == "%s" && $2 == 1.2', s))
set xrange [0:1]; set yrange [0:3]; set xlabel 'part of the step before the touch'; set ylabel 'largest overlap / exact'
set arrow 1 from 0,1 to 1,1 nohead lw 1.4 lc rgb experiment
set tmargin at screen 1 - up(0.9)
set key at screen 0.55,1 - up(0.1) center top maxrows 1
plot NaN with lines lw 1.4 lc rgb experiment title 'exact', \
     of(verlet) using 3:4 with linespoints pt 6 ps 0.6 lw 1 lc rgb verlet_tint title 'position Verlet', \
     of(numerov) using 3:4 with linespoints pt 2 ps 0.6 lw 1 lc rgb numerov_tint title 'Numerov'
