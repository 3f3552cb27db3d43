# title: Error of the contact force after 5 ms
# counterpart: A00 Tables 3.1 to 3.3
# needs: weight_error.csv
# caption: Force less weight, over the weight, against the time step. Open: the source, whose error grows as the step shrinks. Filled: Clast; what is left at damping 0.21 is the oscillation that has not died out yet, the same at all steps; at 0.5 it is below the rounding of the loads.
width = 12; height = 8.5
load style
set logscale xy; set xrange [5e-8:2e-5]; set yrange [1e-13:100]; set format '10^{%T}'
set xlabel 'time step (s)'; set ylabel 'error (% of the weight)'
set lmargin at screen across(1.85); set tmargin at screen 1 - up(1.75); set key at screen 0.55,1 - up(0.1) center top maxrows 3
of(o, d) = rows('weight_error', sprintf('$1 == "%s" && $2 == %g', o, d))
plot of('vertical', 0.5) using 3:5 with linespoints pt 4 ps 1 lw 1.2 lc rgb thesis title 'source, upright, damping 0.5', \
     of('vertical', 0.21) using 3:5 with linespoints pt 6 ps 1 lw 1.2 dt (6,3) lc rgb thesis title 'source, upright, damping 0.21', \
     of('horizontal', 0.5) using 3:5 with linespoints pt 8 ps 1 lw 1.2 dt (2,3) lc rgb thesis title 'source, lying, damping 0.5', \
     of('vertical', 0.5) using 3:4 with linespoints pt 5 ps 1 lw 1.2 lc rgb ours title 'Clast, upright, damping 0.5', \
     of('vertical', 0.21) using 3:4 with linespoints pt 7 ps 1 lw 1.2 dt (6,3) lc rgb ours title 'Clast, upright, damping 0.21', \
     of('horizontal', 0.5) using 3:4 with linespoints pt 9 ps 1 lw 1.2 dt (2,3) lc rgb ours title 'Clast, lying, damping 0.5'
