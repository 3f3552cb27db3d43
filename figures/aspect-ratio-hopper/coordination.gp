# title: Co-ordination number
# counterpart: A00 Fig. 5.7
# needs: consolidation.csv facts.csv
# caption: Left: mean number of touching partners while the beds are made; the longer the particles, the higher the grid that they fall from. Right: of the beds at rest, with the 95 % interval over replicates; crosses: step and stiffness of the source; dashes: the source's 15.1 and 11.3 % less, from our value of aspect 1.
width = 17; height = 6.2
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
set multiplot
set lmargin at screen across(1.5); set rmargin at screen across(10.0)
set xlabel 'time (s)'; set ylabel 'co-ordination number'
set xrange [0:*]; set yrange [0:6]
set key bottom right
plot for [k=1:4] shape('consolidation', k) using 2:3 with lines lw 1.4 lc rgb hue[k] title 'aspect '.k
unset label 999
set lmargin at screen across(11.4); set rmargin at screen across(16.7)
set xlabel 'aspect ratio'; set ylabel ''
set xrange [0.6:4.4]; set xtics 1
unset key
first = number(system(sprintf("awk -F, '$1 == \"co-ordination number\" && $3 == 1 { print $7 }' '%s/facts.csv'", data)))
set arrow 1 from 1.6,0.849 * first to 2.4,0.849 * first nohead dt (6,3) lw 1.4 lc rgb thesis
set arrow 2 from 3.6,0.849 * 0.887 * first to 4.4,0.849 * 0.887 * first nohead dt (6,3) lw 1.4 lc rgb thesis
plot fact('co-ordination number') using 4:7:(spread($8)) with yerrorbars pt 7 ps 0.7 lw 1.2 lc rgb ours, \
     fact('co-ordination number') using 4:7 with lines lw 1.2 lc rgb ours, \
     fact('co-ordination number') using 4:9 with points pt 2 ps 0.9 lw 1.4 lc rgb thesis
unset multiplot
