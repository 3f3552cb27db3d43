# title: Speed against error, double and mixed precision
# counterpart: none, our own measurement
# needs: precision.csv
# caption: Each line joins the two precisions of one measure of error; left is faster. Time: 5000 spheres at rest in a box, one core, widest lanes of the machine. Rebound: an oblique collision against 200 000 steps per contact. Energy: 125 spheres, the largest error met in 10⁶ steps. Creep: from step 10⁵ to 10⁶. Rate: largest change that the 95 % interval of 48 pairs of runs allows; for double, the control whose one sphere starts a nanometre aside.
width = 17; height = 10.5
stamp = 'build/precision.csv'
load style
pick(quantity, of, precision, x, column) = \
    number(system(sprintf("awk -F, '$1 == \"%s\" && $2 == \"%s\" && $3 == \"%s\" && (\"%s\" == \"\" || $4 == \"%s\") { v = $%d } END { print v }' '%s/precision.csv'", quantity, of, precision, x, x, column, data)))
lanes = system(sprintf("awk -F, '$1 == \"speed\" && $2 ~ /^box / { sub(/^box /, \"\", $2); v = $2 } END { print v }' '%s/precision.csv'", data))
ns(precision) = pick('speed', 'box '.lanes, precision, '', 5)
bar(precision) = spread(pick('speed', 'box '.lanes, precision, '', 6))
most(variant) = abs(pick('rate-change', 'hopper', variant, '', 5)) + pick('rate-change', 'hopper', variant, '', 6)
largest(quantity, of, precision) = \
    number(system(sprintf("awk -F, '$1 == \"%s\" && $2 == \"%s\" && $3 == \"%s\" { v = $5 < 0 ? -$5 : $5; if (v > m) m = v } END { print m }' '%s/precision.csv'", quantity, of, precision, data)))
array title[6] = ['rate of a hopper', 'rebound, 30 steps per contact', 'rebound, 1000 steps per contact', 'energy, neither friction nor damping', 'energy balance, bed on a belt', 'creep of a bed at rest, in radii']
array tint[6] = [experiment, thesis, '#E69F00', ours, frictional, '#CC79A7']
array mark[6] = [13, 5, 4, 7, 9, 11]
array double_error[6]; array mixed_error[6]
double_error[1] = most('nudged'); mixed_error[1] = most('mixed')
double_error[2] = pick('rebound', 'oblique', 'double', '30', 5); mixed_error[2] = pick('rebound', 'oblique', 'mixed', '30', 5)
double_error[3] = pick('rebound', 'oblique', 'double', '1000', 5); mixed_error[3] = pick('rebound', 'oblique', 'mixed', '1000', 5)
double_error[4] = largest('energy', 'bounce', 'double'); mixed_error[4] = largest('energy', 'bounce', 'mixed')
double_error[5] = largest('residual', 'flow', 'double'); mixed_error[5] = largest('residual', 'flow', 'mixed')
creep(p) = abs(pick('sinking', 'rest', p, '1000000', 5) - pick('sinking', 'rest', p, '100000', 5))
double_error[6] = creep('double'); mixed_error[6] = creep('mixed')
set logscale y
set yrange [3e-9:1e-1]
set format y '10^{%T}'
set ytics 10
set xlabel 'ns per sphere-step, '.lanes
set ylabel 'relative error'
array shift[6] = [0, 0.1, 0.25, -0.1, -0.25, 0]
a = ns('mixed'); b = ns('double'); room = 0.35 * abs(b - a) + 3
set xrange [(a < b ? a : b) - room:(a < b ? b : a) + 3.4 * room]
set label 1 'mixed' at first a, graph 1.03 center tc rgb ink
set label 2 'double' at first b, graph 1.03 center tc rgb ink
set tmargin at screen 1 - up(0.8)
set arrow 1 from first a, graph 0 to first a, graph 1 nohead lw 0.7 lc rgb hair back
set arrow 2 from first b, graph 0 to first b, graph 1 nohead lw 0.7 lc rgb hair back
do for [i=1:6] { set label 10 + i title[i] at first b + 0.25 * room, first double_error[i] * 10**shift[i] left font small tc rgb tint[i] }
x(k) = k == 0 ? a : b
y(i, k) = k == 0 ? mixed_error[i] : double_error[i]
plot for [i=1:6] [k=0:1] '+' using (x($0)):(y(i, $0)) every ::0::1 with linespoints lw 1.2 pt mark[i] ps 0.9 lc rgb tint[i]
