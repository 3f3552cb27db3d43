# title: Pseudo-friction, and what less of it costs
# counterpart: A00 Table 3.4; beyond q = 4 our own
# needs: pseudo.csv pseudo_starts.csv pseudo_ways.csv
# caption: (a) Friction by the slope of t² over the way (A00 3.13) against spheres per diameter: every start position a dot, mean and range; squares: the source's three numbers. Broken line: 0.03, which the source calls negligible. (b) The same against the largest deviation of the contact normal. (c) Range over start positions against the part of the way that the slope is fitted to, q = 1, 2 and 4; broken: the source, which does not print its part. (d) Processor time per step, contacts of the sliding particle and pairs looked at; four particles, one core.
width = 17; height = 15
load style
gap = 1.3
load tools.'/particle-checks/panels.gpi'
array q[3] = [1, 2, 4]
array printed[3] = [0.41, 0.22, 0.03]
range_of(k) = sprintf("< awk -F, '$1 == %g { if (!($3 in l) || $4 < l[$3]) l[$3] = $4; if (!($3 in m) || $4 > m[$3]) m[$3] = $4 } END { for (w in l) print w \",\" l[w] \",\" m[w] }' '%s/pseudo_ways.csv' | sort -g", k, data)
set multiplot
set key at graph 0.97,0.97 right top
set lmargin at screen left(1, 2); set rmargin at screen right(1, 2)
set bmargin at screen low(1, 2); set tmargin at screen high(1, 2)
set logscale x 2; set xrange [0.85:19]; set xtics (1, 2, 4, 8, 16); set yrange [-0.05:0.6]
set xlabel 'spheres per diameter, q'; set ylabel 'pseudo-friction'; set format y '%.1f'
set label 1 letter(1) at graph 0,1.06
plot 0.03 with lines lw 0.8 dt (6,4) lc rgb faint notitle, \
     rows('pseudo_starts', '1') using 1:3 with points pt 7 ps 0.25 lc rgb ours_light notitle, \
     rows('pseudo', '1') using 1:5:7:8 with yerrorbars pt 7 ps 0.7 lw 1.2 lc rgb ours title 'Clast', \
     rows('pseudo', '$15 !~ /nan/') using 1:15 with points pt 4 ps 1.2 lw 1.4 lc rgb thesis title 'source'
unset label 999
unset logscale x; set xrange [0:31]; set xtics 10
set xlabel 'deviation of the normal (degrees)'
set lmargin at screen left(2, 2); set rmargin at screen right(2, 2)
set label 1 letter(2)
set key at graph 0.03,0.97 left top
plot 0.03 with lines lw 0.8 dt (6,4) lc rgb faint notitle, \
     rows('pseudo', '1') using 3:5:7:8 with yerrorbars pt 7 ps 0.7 lw 1.2 lc rgb ours title 'Clast', \
     rows('pseudo', '$15 !~ /nan/') using 3:15 with points pt 4 ps 1.2 lw 1.4 lc rgb thesis title 'source'
set bmargin at screen low(2, 2); set tmargin at screen high(2, 2)
set lmargin at screen left(1, 2); set rmargin at screen right(1, 2)
set label 1 letter(3)
set xrange [0:17.5]; set xtics 5; set yrange [-0.1:0.8]; set xlabel 'way that is fitted (cm)'
set key at graph 0.97,0.97 right top
set style fill transparent solid 0.45 noborder
plot for [k=1:3] range_of(q[k]) using ($1*100):2:3 with filledcurves lc rgb tone[2*k-1] title sprintf('q = %d', q[k]), \
     for [k=1:3] printed[k] with lines lw 1.2 dt (6,4) lc rgb tone[2*k-1] notitle
set lmargin at screen left(2, 2); set rmargin at screen right(2, 2)
set label 1 letter(4)
set key at graph 0.03,0.97 left top
set logscale x 2; set xrange [0.85:19]; set xtics (1, 2, 4, 8, 16)
set logscale y; set yrange [0.8:1500]; set format y '%g'
set xlabel 'spheres per diameter, q'; set ylabel 'cost'
plot rows('pseudo', '1') using 1:14 with linespoints pt 7 ps 0.7 lw 1.2 lc rgb ours title 'µs per step', \
     rows('pseudo', '1') using 1:12 with linespoints pt 6 ps 0.8 lw 1.2 lc rgb frictional title 'contacts', \
     rows('pseudo', '1') using 1:13 with linespoints pt 8 ps 0.8 lw 1.2 lc rgb ink title 'pairs looked at'
unset multiplot
