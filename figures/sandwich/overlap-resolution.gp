# title: Largest overlap against steps per contact
# counterpart: S12 Fig. 3.13
# needs: approach.csv
# caption: The touch comes on a step, the worst place. Curves have corners where another step becomes the deepest; above 5 steps per contact the two schemes are within 2.5 % of each other.
width = 12; height = 8
load style
load tools.'/sandwich/sandwich.gpi'
of(s) = rows('approach', sprintf('$1 == "%s" && $2 > 1.2', s))
set logscale x; set xrange [1.2:50]; set xtics (1.2, 2, 5, 10, 20, 50); set yrange [0:3]; set xlabel 'steps per contact'; set ylabel 'largest overlap / exact'
set arrow 1 from 1.2,1 to 50,1 nohead lw 1.4 lc rgb experiment
set tmargin at screen 1 - up(0.9)
set key at screen 0.55,1 - up(0.1) center top maxrows 1
plot NaN with lines lw 1.4 lc rgb experiment title 'exact', \
     of(verlet) using 2:4 with linespoints pt 6 ps 0.5 lw 1 lc rgb verlet_tint title 'position Verlet', \
     of(numerov) using 2:4 with linespoints pt 2 ps 0.5 lw 1 lc rgb numerov_tint title 'Numerov'
