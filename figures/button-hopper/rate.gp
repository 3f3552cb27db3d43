# title: Rate against orifice
# counterpart: A00 Fig. 4.15
# needs: summary.csv rates.csv
# caption: Steady rate, from the linear part of each cumulative curve. Small dots: replicates; large: their mean with its 95 % interval. Experiment and thesis simulation: Tables 4.4 and 4.5. Below: the difference from the experiment; the shaded strip is the mean |error| of the thesis's own model, 10.8 %.
width = 12; height = 12
load style
set multiplot
set xrange [4.4:10.6]; set xtics ('' 5, '' 6.5, '' 7.5, '' 8.5, '' 10)
set bmargin at screen 0.43
set yrange [0:*]; set ytics 40; set ylabel 'steady rate (g/s)'
set key top left
plot rows('rates', '$1 == "frictionless"') using ($2 + 0.1):4 with points pt 7 ps 0.35 lc rgb ours_light, \
     rows('summary', '$1 == "frictionless"') using 2:7 with linespoints lw 0.9 dt (6,4) pt 7 ps 0.8 lc rgb experiment title 'experiment', \
     rows('summary', '$1 == "frictionless"') using 2:8 with linespoints lw 0.9 dt (2,3) pt 9 ps 0.8 lc rgb thesis title 'thesis simulation', \
     rows('summary', '$1 == "frictional"') using ($2 - 0.1):5:(spread($6)) with yerrorbars pt 4 ps 0.6 lw 0.9 lc rgb frictional title 'Clast, frictional fill', \
     rows('summary', '$1 == "frictional"') using ($2 - 0.1):5 with points pt 4 ps 0.6 lw 0.9 lc rgb frictional, \
     rows('summary', '$1 == "frictionless"') using ($2 + 0.1):5:(spread($6)) with yerrorbars pt 7 ps 0.8 lw 1.2 lc rgb ours title 'Clast, frictionless fill', \
     rows('summary', '$1 == "frictionless"') using ($2 + 0.1):5 with points pt 7 ps 0.8 lc rgb ours

unset label 999; unset key
set tmargin at screen 0.395; set bmargin at screen up(1.75)
set xtics ('5' 5, '6.5' 6.5, '7.5' 7.5, '8.5' 8.5, '10' 10)
set xlabel 'orifice width D (cm)'
set ylabel 'difference (%)'
set yrange [*:*]; set ytics 10
set xzeroaxis lt 1 lw 0.9 lc rgb experiment
set object 1 rectangle from graph 0, first -10.8 to graph 1, first 10.8 fs solid 1 noborder fc rgb '#f0f0f0' behind
difference(v, e) = 100 * (v / e - 1)
plot rows('summary', '$1 == "frictionless"') using 2:(difference($8, $7)) with linespoints lw 0.9 dt (2,3) pt 9 ps 0.8 lc rgb thesis, \
     rows('summary', '$1 == "frictional"') using ($2 - 0.1):(difference($5, $7)) with points pt 4 ps 0.6 lw 0.9 lc rgb frictional, \
     rows('summary', '$1 == "frictionless"') using ($2 + 0.1):(difference($5, $7)):(100 * spread($6) / $7) with yerrorbars pt 7 ps 0.8 lw 1.2 lc rgb ours, \
     rows('summary', '$1 == "frictionless"') using ($2 + 0.1):(difference($5, $7)) with points pt 7 ps 0.8 lc rgb ours
unset multiplot
