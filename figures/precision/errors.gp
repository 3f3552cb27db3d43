# title: What mixed precision changes
# counterpart: none, our own measurement
# needs: precision.csv
# caption: Oblique collision: error against 200 000 steps per contact; the two lie on each other, and their difference is what rounding does. Energy: 125 spheres without friction and damping, change of the total; a bed on a belt, residual of the ledger; both of the energy put in. Creep: sinking of the mean height of a bed at rest since step 20 000. Rate: hopper of one layer, 48 replicates, mean with 95 % interval; nudged: double, one sphere a nanometre aside.
width = 17.0; height = 13.6
stamp = 'build/precision.csv'
load style
set multiplot
table(q, c, p) = rows('precision', sprintf('$1 == "%s" && $2 == "%s" && $3 == "%s"', q, c, p))
left = 'set lmargin at screen across(1.75); set rmargin at screen across(8.0)'
right = 'set lmargin at screen across(10.4); set rmargin at screen across(16.65)'
above = 'set tmargin at screen up(12.3); set bmargin at screen up(8.1)'
below = 'set tmargin at screen up(5.6); set bmargin at screen up(1.75)'
set xlabel offset 0, 0.3
set logscale xy
set format '10^{%T}'
set key at graph 0, 1.04 left bottom font small

eval left; eval above
set key maxrows 2 width -4
set yrange [1e-8:1e-1]; set ytics 100
set xlabel 'steps per contact'; set ylabel 'error of the rebound'
plot table('rebound', 'oblique', 'double') using 4:5 with linespoints lw 1.2 pt 6 ps 0.9 lc rgb experiment title 'double', \
     table('rebound', 'oblique', 'mixed') using 4:5 with points pt 2 ps 0.6 lc rgb ours title 'mixed', \
     table('rounding', 'oblique', 'mixed') using 4:5 with linespoints lw 1.2 dt (3,2) pt 7 ps 0.5 lc rgb ours_light title 'their difference'

unset label 999
eval right
set key width 0
set yrange [1e-5:1e-2]; set ytics 10; set xrange [1e3:1e6]
set xlabel 'steps'; set ylabel 'energy error'
plot table('energy', 'bounce', 'double') using 4:(abs($5)) with linespoints lw 1.2 pt 6 ps 0.6 lc rgb experiment title 'double, no losses', \
     table('energy', 'bounce', 'mixed') using 4:(abs($5)) with linespoints lw 1.2 pt 2 ps 0.6 lc rgb ours title 'mixed, no losses', \
     table('residual', 'flow', 'double') using 4:(abs($5)) with linespoints lw 0.9 dt (6,3) pt 4 ps 0.5 lc rgb faint title 'double, on a belt', \
     table('residual', 'flow', 'mixed') using 4:(abs($5)) with linespoints lw 0.9 dt (6,3) pt 1 ps 0.5 lc rgb ours_light title 'mixed, on a belt'

unset logscale
set format '%g'
eval left; eval below
set yrange [*:*]; set ytics auto; set xrange [0:1.05]; set xtics auto
set xlabel 'steps (10^6)'; set ylabel 'sinking (10^{−6} radii)'
start(p) = system(sprintf("awk -F, '$1 == \"sinking\" && $3 == \"%s\" && $4 == 20000 { print $5 }' '%s/precision.csv'", p, data)) + 0
from_double = start('double'); from_mixed = start('mixed')
plot table('sinking', 'rest', 'double') using ($4 < 20000 ? NaN : $4 / 1e6):(1e6 * ($5 - from_double)) with linespoints lw 1.2 pt 6 ps 0.7 lc rgb experiment title 'double', \
     table('sinking', 'rest', 'mixed') using ($4 < 20000 ? NaN : $4 / 1e6):(1e6 * ($5 - from_mixed)) with linespoints lw 1.2 pt 2 ps 0.7 lc rgb ours title 'mixed'

unset key
eval right
set xrange [-0.6:2.6]; set xtics ('double' 0, 'mixed' 1, 'nudged' 2)
set xlabel 'precision'; set ylabel 'rate (spheres/s)'
place(p) = p eq 'double' ? 0 : p eq 'mixed' ? 1 : 2
plot rows('precision', '$1 == "rate"') using (place(strcol(3)) - 0.12):5 with points pt 7 ps 0.35 lc rgb ours_light, \
     rows('precision', '$1 == "mean-rate"') using (place(strcol(3)) + 0.12):5:6 with yerrorbars pt 7 ps 0.8 lw 1.2 lc rgb ours, \
     rows('precision', '$1 == "mean-rate"') using (place(strcol(3)) + 0.12):5 with points pt 7 ps 0.8 lc rgb ours
unset multiplot
