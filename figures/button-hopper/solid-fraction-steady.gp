# title: Solid fraction in steady flow
# counterpart: A00 Fig. 4.12b
# needs: summary.csv
# caption: Mean solid fraction over the steady part of the flow, both fills, with 95 % intervals. From the bulk densities of Tables 4.4 and 4.5 and the area and mass of a button (0.289 g/cm² when nothing is empty) follow the values for the experiment and the thesis simulation.
width = 12; height = 8
load style
full = 0.332 / (pi * 0.69 * 0.53)   # g/cm2 of a bed without voids
set format y '%.2f'
set xlabel 'orifice width D (cm)'; set ylabel 'solid fraction in steady flow'
set xrange [4.4:10.6]; set xtics ('5' 5, '6.5' 6.5, '7.5' 7.5, '8.5' 8.5, '10' 10)
set yrange [*:*]; set offsets 0, 0, 0.005, 0.005
set tmargin at screen 1 - up(1.35); set key at screen 0.56,1 - up(0.12) center top maxrows 2 width -2
plot rows('summary', '$1 == "frictionless"') using 2:($11 / full) with linespoints lw 0.9 dt (6,4) pt 7 ps 0.8 lc rgb experiment title 'experiment', \
     rows('summary', '$1 == "frictionless"') using 2:($12 / full) with linespoints lw 0.9 dt (2,3) pt 9 ps 0.8 lc rgb thesis title 'thesis simulation', \
     rows('summary', '$1 == "frictionless"') using ($2 + 0.1):13:(spread($14)) with yerrorbars pt 7 ps 0.8 lw 1.2 lc rgb ours title 'Clast, frictionless fill', \
     rows('summary', '$1 == "frictionless"') using ($2 + 0.1):13 with points pt 7 ps 0.8 lc rgb ours, \
     rows('summary', '$1 == "frictional"') using ($2 - 0.1):13:(spread($14)) with yerrorbars pt 4 ps 0.7 lw 0.9 lc rgb frictional title 'Clast, frictional fill', \
     rows('summary', '$1 == "frictional"') using ($2 - 0.1):13 with points pt 4 ps 0.7 lw 0.9 lc rgb frictional
