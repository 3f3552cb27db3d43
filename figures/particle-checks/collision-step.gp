# title: An elastic collision at large and small steps
# counterpart: A00 Figs 3.4 and 3.5
# needs: impulse_curves.csv impulse.csv
# caption: The upright particle meets the floor at the speed of a fall from 10 mm (assumed), without damping; steps over the critical one. (a), (b) Force; the touch falls on a step. (c) Error of half the area under the force against m v: the source's three numbers; Clast where the touch falls on a step, as in the source, and the worst of eight places within a step; band: on a step, falls from 1 mm to 1 m.
width = 17; height = 8
load style
load tools.'/particle-checks/panels.gpi'
of(r) = rows('impulse_curves', sprintf('$1 == %g', r))
set multiplot
set bmargin at screen low(1, 1); set tmargin at screen high(1, 1)
set xrange [0:130]; set yrange [0:*]; set xtics 40
set xlabel 'time (µs)'; set ylabel 'force (N)'
array coarse[3] = [5, 2.5, 1]; array fine[4] = [1, 0.5, 0.1, 0.01]
set lmargin at screen left(1, 3); set rmargin at screen right(1, 3)
set label 1 letter(1) at graph 0,1.06
plot for [k=1:3] of(coarse[k]) using ($2*1e6):3 with linespoints pt 7 ps 0.5 lw 1.2 lc rgb tone[2*k-1] title sprintf('%g', coarse[k])
unset label 999
set lmargin at screen left(2, 3); set rmargin at screen right(2, 3)
set label 1 letter(2); set ylabel ''
plot for [k=1:4] of(fine[k]) using ($2*1e6):3 with lines lw (k == 4 ? 0.8 : 1.4) lc rgb tone[k] title sprintf('%g', fine[k])
set lmargin at screen left(3, 3); set rmargin at screen right(3, 3)
set label 1 letter(3)
set logscale xy; set xrange [0.007:8]; set yrange [1e-6:100]; set format '10^{%T}'; set xtics autofreq
set xlabel 'step / critical step'; set ylabel 'error (%)'
set key at graph 0.02,0.98 left top Left reverse samplen 1.2
spread_of = sprintf("< awk -F, 'NR > 1 { if (!($1 in l) || $3 < l[$1]) l[$1] = $3; if ($3 > m[$1]) m[$1] = $3 } END { for (r in l) print r \",\" l[r] \",\" m[r] }' '%s/impulse.csv' | sort -g", data)
plot spread_of using 1:2:3 with filledcurves lc rgb ours_pale title '1 mm to 1 m', \
     rows('impulse', '$2 == 0.01') using 1:4 with linespoints pt 2 ps 0.7 lw 1 lc rgb ours title 'worst place', \
     rows('impulse', '$2 == 0.01') using 1:3 with linespoints pt 7 ps 0.7 lw 1.2 lc rgb ours title 'on a step', \
     rows('impulse', '$2 == 0.01') using 1:5 with points pt 4 ps 1.2 lw 1.4 lc rgb thesis title 'source'
unset multiplot
