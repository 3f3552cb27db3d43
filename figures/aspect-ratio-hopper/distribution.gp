# title: Distribution of the solid fraction over the cells
# counterpart: A00 Fig. 5.4
# needs: distribution.csv
# caption: Percent of all cells that hold a particle, in bands of 0.05, all replicates at the cheaper setting together. The tail on the left is the surface.
width = 8.2; height = 6.2
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
set xlabel 'solid fraction'; set ylabel 'cells (%)'
set xrange [0:1.1]; set yrange [0:*]
set key top left
plot for [k=1:4] shape('distribution', k) using ($2 + 0.025):3 with linespoints lw 1.3 pt mark[k] ps 0.5 lc rgb hue[k] title 'aspect '.k
