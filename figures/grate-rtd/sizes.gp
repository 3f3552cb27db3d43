# title: Residence time by size
# counterpart: none; S12 4.7.3 says that small particles are trapped under the bed
# needs: sizes.csv
# caption: Mean residence time of clay by diameter, in nine classes, with the 95 % interval of the tracers in each.
width = 12; height = 7.5
load style
array name[2] = ['forward clay', 'backward clay']
array word[2] = ['forward', 'backward']
array hue[2] = [ours, thesis]
set xrange [11.5:21.5]; set yrange [0:*]
set xlabel 'diameter (mm)'; set ylabel 'mean residence time (min)'
set key bottom right
plot for [k=1:2] rows('sizes', sprintf('$1 == "%s"', name[k])) using 2:3:(spread($4)) with yerrorbars pt (k == 1 ? 7 : 5) ps 0.7 lw 1.1 lc rgb hue[k] title word[k]
