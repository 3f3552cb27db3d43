# title: Orientation of nine particles
# counterpart: A00 Fig. 5.12
# needs: tracks.csv
# caption: Angle of the particle's axis (of a mark on a sphere) from the horizontal, without the jumps of full turns, until it has left the hopper. Aspect ratios 1 (top) and 3 (bottom).
width = 17; height = 9.7
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
column = 7; name = 'angle (deg)'; low = -450; high = 450
set ytics 180; set xtics 0.5
load tools.'/aspect-ratio-hopper/tracked.gpi'
