# title: Lateral velocity of nine particles
# counterpart: A00 Fig. 5.13
# needs: tracks.csv
# caption: Horizontal velocity until the particle has left the hopper; aspect ratios 1 (top) and 3 (bottom).
width = 17; height = 9.7
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
column = 8; name = 'velocity (cm/s)'; low = -180; high = 180
set ytics 90; set xtics 0.5
set xzeroaxis lt 1 lw 0.5 lc rgb faint
load tools.'/aspect-ratio-hopper/tracked.gpi'
