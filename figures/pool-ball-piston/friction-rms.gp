# title: Distance from the reference against friction
# counterpart: A00 4.2.2, numbers in the text
# needs: friction.csv
# caption: Root mean square over particles and frames. Blue: five replicates at each friction from the mean of our ensemble at the measured static friction (0.357 / 0.351), with the 95 % interval of their mean; hollow: the model run. Green: the same from our ensemble at 0.1. Vermilion, right axis: the thesis's model from its experiment; how that number is normalised is not said, so only the order can be compared.
width = 12; height = 8.6
load style
set rmargin at screen 1 - across(1.8); set tmargin at screen 1 - up(1.2)
set xrange [-0.02:0.38]; set xtics (0, 0.1, 0.2, 0.35); set xlabel 'friction'
set yrange [0:*]; set y2range [0:1200]; set ylabel 'RMS, ours (mm)'; set y2label 'RMS, thesis (mm)' tc rgb thesis
set y2tics 200 tc rgb thesis; set border 11
set key at screen 0.5,1 - up(0.1) center top maxrows 2
table = rows('friction', '1')
plot table using 1:7:(spread($8)) with yerrorbars pt 7 ps 0.9 lw 1.1 lc rgb ours title 'from ours, static friction', \
     table using ($1+0.006):6 with points pt 6 ps 0.9 lc rgb ours title 'model run', \
     table using ($1-0.006):4:(spread($5)) with yerrorbars pt 9 ps 0.9 lw 1.1 lc rgb frictional title 'from ours, 0.1', \
     table using 1:2 axes x1y2 with linespoints pt 5 ps 0.9 lw 1 dt 2 lc rgb thesis title 'thesis'
