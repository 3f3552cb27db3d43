# title: Force on the bottom while the bed is made
# counterpart: A00 Fig. 5.8
# needs: consolidation.csv
# caption: Over the weight of the bed, without friction; it must be 1 in the end. Particles that land, and the bed that rings behind them, make it more and less; then global damping stops the ringing (not shown), and the bed carries its weight. The verdicts take the mean of the last 0.25 s shown here.
width = 8.2; height = 6.2
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
set xlabel 'time (s)'; set ylabel 'force on the bottom over weight'
set xrange [0:*]; set yrange [0:3.5]
set arrow 1 from graph 0,first 1 to graph 1,first 1 nohead lw 0.8 dt (6,3) lc rgb experiment front
set key top right
plot for [k=1:4] shape('consolidation', k) using 2:4 with lines lw 1 lc rgb hue[k] title 'aspect '.k
