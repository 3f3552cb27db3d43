# title: A ball between two walls, 0.1 ms per step
# counterpart: S12 Fig. 3.6
# needs: positions.csv
# caption: Position over that at the start, against time over 0.45 s; every third point of the schemes. 52 steps per contact. Position Verlet is ahead by 0.04 rad after 0.45 s, Numerov by 8e-6.
width = 17; height = 7.5
load style
load tools.'/sandwich/sandwich.gpi'
T = 0.45
set xrange [0.4/T:1]; set yrange [-1.15:1.15]; set xlabel 'time / 0.45 s'; set ylabel 'position / position at the start'
set xzeroaxis lt 1 lw 0.5 lc rgb faint
set tmargin at screen 1 - up(0.9)
set key at screen 0.55,1 - up(0.1) center top maxrows 1
plot exact(0.4, T) using ($3/T):4 with lines lw 1.4 lc rgb experiment title 'exact (S12 3.56)', \
     at(1e-4, verlet, 0.4, T) using ($3/T):4 every 3 with points pt 6 ps 0.8 lc rgb verlet_tint title 'position Verlet', \
     at(1e-4, numerov, 0.4, T) using ($3/T):4 every 3 with points pt 2 ps 0.6 lc rgb numerov_tint title 'Numerov'
