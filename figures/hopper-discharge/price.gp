# title: What a simulated second costs
# counterpart: none, our own measurement
# needs: prices.csv
# caption: While the hopper is nearly full, one run at a time on one processor. Left: evaluations of all contact forces; position Verlet and the leapfrog make one per step. Right: processor time. Gauss-Seidel is the source's linear solver, conjugate gradients ours.
width = 17; height = 8.5
load style
load tools.'/hopper-discharge/discharge.gpi'
array kind[5] = ['leapfrog', 'position-verlet', 'numerov-central', 'numerov-central, tolerance 1e-6', 'numerov-central, Gauss-Seidel']
array says[5] = ['leapfrog', 'position Verlet', 'Numerov', 'Numerov, tolerance 10^{−6}', 'Numerov, Gauss-Seidel']
array ink_of[5] = [frictional, thesis, ours, '#56B4E9', '#CC79A7']
array mark_of[5] = [6, 5, 7, 9, 13]
# the name is quoted where it holds a comma: fields are counted from the end
priced(k) = sprintf("< awk -F, 'NR > 1 { n = $0; sub(/^\"/, \"\", n); if (index(n, \"%s\") == 1 && substr(n, length(\"%s\") + 1) ~ /^\"?,[0-9]/) print $(NF-4) \",\" $(NF-3) \",\" $NF }' '%s/prices.csv'", kind[k], kind[k], data)
set multiplot
set logscale xy; set xrange [0.08:1]; set xtics (0.1, 0.2, 0.4, 0.6, 0.8)
set xlabel 'time step, ms'
set tmargin at screen 1 - up(1.4)
set lmargin at screen across(1.9); set rmargin at screen 0.5 - across(0.1)
set ylabel 'force evaluations / s'; set format y '10^{%T}'
set key at screen 0.5,1 - up(0.1) center top maxrows 2 font small
plot for [k=1:5] priced(k) using (1e3 * $1):2 with linespoints lw 1.2 pt mark_of[k] ps 0.8 lc rgb ink_of[k] title says[k]
unset label 999; unset key
set lmargin at screen 0.5 + across(1.9); set rmargin at screen 1 - across(0.35)
set ylabel 'processor time, s / s'; set format y '%g'
plot for [k=1:5] priced(k) using (1e3 * $1):3 with linespoints lw 1.2 pt mark_of[k] ps 0.8 lc rgb ink_of[k]
unset multiplot
