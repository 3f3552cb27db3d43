# title: Force of the lobes while one sphere is passed
# counterpart: A00 Figs 3.18 to 3.20
# needs: pseudo_force_off.csv
# caption: From a hundredth of a spacing out of a nest to the next one. (a) Direction of the net contact force on the sliding particle against that of sliding: 90° on a smooth surface, 120°, 104° and 97° from the nests of q = 1, 2 and 4 (dotted). (b) Its part along the way; below 0 it brakes. (c) The same in means of a tenth of the spacing. The impact on the next lobe (beyond 0.9) is cut off; at q = 1 the particle leaves the lobe at 0.8.
width = 17; height = 8
load style
load tools.'/particle-checks/panels.gpi'
array q[3] = [1, 2, 4]
of(k) = rows('pseudo_force_off', sprintf('$1 == %g && $3 >= 0', k))
mean(k) = sprintf("< awk -F, '$1 == %g && $3 >= 0 { b = int(10 * $3); n[b]++; s[b] += $5 } END { for (b = 0; b < 9; b++) if (n[b]) print (b + 0.5) / 10 \",\" s[b] / n[b] }' '%s/pseudo_force_off.csv'", k, data)
set multiplot
set bmargin at screen low(1, 1); set tmargin at screen high(1, 1)
set xrange [0:1]; set xtics 0.25; set format x '%g'; set xlabel 'way / spacing'
set key at graph 0.03,0.05 left bottom
set lmargin at screen left(1, 3); set rmargin at screen right(1, 3)
set label 1 letter(1) at graph 0,1.06
set ylabel 'direction (degrees)'; set yrange [60:135]; set ytics 15
nest(k) = 90 + asin(0.5 / k) * 180 / pi
plot for [k=1:3] nest(q[k]) with lines lw 0.8 dt (1,4) lc rgb tone[2*k-1] notitle, \
     for [k=1:3] of(q[k]) using 3:4 with points pt 7 ps 0.25 lc rgb tone[2*k-1] title sprintf('q = %d', q[k])
unset label 999
set lmargin at screen left(2, 3); set rmargin at screen right(2, 3)
set label 1 letter(2); set ylabel 'force along the way (N)'; set yrange [-0.3:0.1]; set ytics 0.1; set key at graph 0.98,0.05 right bottom; set format y '%.1f'
set xzeroaxis lt 1 lw 0.5 lc rgb faint
plot for [k=1:3] of(q[k]) using 3:5 with points pt 7 ps 0.25 lc rgb tone[2*k-1] title sprintf('q = %d', q[k])
set lmargin at screen left(3, 3); set rmargin at screen right(3, 3)
set label 1 letter(3); set ylabel 'mean force along the way (N)'
plot for [k=1:3] mean(q[k]) using 1:2 with linespoints pt 7 ps 0.6 lw 1.2 lc rgb tone[2*k-1] title sprintf('q = %d', q[k])
unset multiplot
