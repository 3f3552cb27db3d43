# title: A ball between two walls, 3.5 ms per step
# counterpart: none: S12 3.9.1, text
# needs: positions.csv
# caption: Position over the radius; at 1 the centre has reached a wall. 1.5 steps per contact, h = 2.13: beyond position Verlet's limit of 2 and below Numerov's of 2.45. Position Verlet throws the ball out in its fourth step and the guard ends the run; Numerov swings on at the amplitude of the start, with a wrong phase.
width = 17; height = 7.5
load style
load tools.'/sandwich/sandwich.gpi'
set xrange [0:0.1]; set yrange [-1.4:1.4]; set xlabel 'time, s'; set ylabel 'position / radius'
set xzeroaxis lt 1 lw 0.5 lc rgb faint
set arrow 1 from 0,1 to 0.1,1 nohead lw 0.8 dt 2 lc rgb faint; set arrow 2 from 0,-1 to 0.1,-1 nohead lw 0.8 dt 2 lc rgb faint
set label 1 'wall' at 0.099,1.1 right tc rgb faint
set tmargin at screen 1 - up(0.9)
set key at screen 0.55,1 - up(0.1) center top maxrows 1
plot exact(0, 0.1) using 3:(0.15*$4) with lines lw 1.4 lc rgb experiment title 'exact (S12 3.56)', \
     at(3.5e-3, verlet, 0, 0.1) using 3:(0.15*$4) with linespoints pt 6 ps 0.9 lw 1 lc rgb verlet_tint title 'position Verlet', \
     at(3.5e-3, numerov, 0, 0.1) using 3:(0.15*$4) with linespoints pt 2 ps 0.7 lw 0.8 dt 3 lc rgb numerov_tint title 'Numerov'
