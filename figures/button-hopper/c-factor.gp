# title: Factor C of the Beverloo equation
# counterpart: A00 Tables 4.4 to 4.6
# needs: summary.csv
# caption: C of eq. 4.5 with kd = 0.89 cm and the bulk density in flow (areal, so C is per cm; C·d ≈ 0.47 is the pure number). Ours: frictionless fill, mean of the replicates with 95 % interval. Strip: 0.39 ± 0.05, the tolerance of the mean over the orifices.
width = 12; height = 7.5
load style
set xlabel 'orifice width D (cm)'; set ylabel 'C (1/cm)'
set xrange [4.4:10.6]; set xtics ('5' 5, '6.5' 6.5, '7.5' 7.5, '8.5' 8.5, '10' 10)
set yrange [*<0.32:0.46<*]; set format y '%.2f'; set ytics 0.05
set tmargin at screen 1 - up(0.9); set key at screen 0.56,1 - up(0.12) center top maxrows 1
set object 1 rectangle from graph 0, first 0.34 to graph 1, first 0.44 behind fs solid 1 noborder fc rgb '#f0f0f0'
plot rows('summary', '$1 == "frictionless"') using 2:17 with linespoints lw 0.9 dt (6,4) pt 7 ps 0.8 lc rgb experiment title 'experiment', \
     rows('summary', '$1 == "frictionless"') using 2:18 with linespoints lw 0.9 dt (2,3) pt 9 ps 0.8 lc rgb thesis title 'thesis', \
     rows('summary', '$1 == "frictionless"') using ($2 + 0.1):15:(spread($16)) with yerrorbars pt 7 ps 0.8 lw 1.2 lc rgb ours title 'Clast'
