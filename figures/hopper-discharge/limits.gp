# title: The step at which a discharge fails
# counterpart: S12 3.9.3, text; none as a figure
# needs: limits.csv
# caption: By initial state. Bars: the scheme's limit (2 and √6) over the largest frequency of the contacts of the settled bed, an eigenvalue of 4020 displacements. Marks, from below: more spheres are through walls than at 0.1 ms; 5 % of the energy of the bed is made; the run stops. Dashes: the steps at which the source saw failure.
width = 17; height = 8.5
load style
load tools.'/hopper-discharge/discharge.gpi'
set xlabel 'initial state'; set ylabel 'time step, ms'
stats rows('limits', '$2 == 0') using 3 nooutput
set yrange [0.6:2.0]
set xrange [0.5:STATS_max + 0.5]; set xtics 1
set rmargin at screen 1 - across(5.4); set key at screen 1 - across(5.2),1 - up(0.5) left top
set arrow 1 from graph 0, first 1.0 to graph 1, first 1.0 nohead dt '-' lw 1.2 lc rgb tints[2]
set arrow 2 from graph 0, first 1.2 to graph 1, first 1.2 nohead dt '-' lw 1.2 lc rgb tints[3]
pick(m, c) = rows('limits', sprintf('$1 == "%s" && $2 == 0 && $4 == "%s"', method[m], c))
plot for [m=2:3] pick(m, 'stopped') using 3:(1e3 * $8):(0.32) with xerrorbars pt 0 lw 2 lc rgb tints[m] title words[m].': bed', \
     for [m=2:3] pick(m, 'through walls') using ($3 - 0.1):(1e3 * $7) with points pt 8 ps 1.1 lw 1.3 lc rgb tints[m] title 'through walls', \
     for [m=2:3] pick(m, 'energy') using 3:(1e3 * $7) with points pt 6 ps 1.1 lw 1.3 lc rgb tints[m] title '5 % of energy made', \
     for [m=2:3] pick(m, 'stopped') using ($3 + 0.1):(1e3 * $7) with points pt 5 ps 1.0 lc rgb tints[m] title 'run stops', \
     NaN with lines dt '-' lw 1.2 lc rgb tints[2] title 'source: 1.0 ms', \
     NaN with lines dt '-' lw 1.2 lc rgb tints[3] title 'source: 1.2 ms'
