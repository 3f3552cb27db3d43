# title: How many spheres touch
# counterpart: A00 Figs 3.10 and 3.11
# needs: slide.csv landing.csv
# caption: One solid as 3, 5, 7 and 9 spheres, friction 0.3, damping 0.21. (a) With the tangential dashpot on top of friction (law.c) more spheres brake more, as in the source's figure; 9 spheres with half the damping (dashed) come closer to 3. (b) With Clast's own law, where friction limits spring and dashpot together, the way does not depend on the number, with a dashpot for each (open) or one shared (filled). (c) Rebound of a flat landing: a dashpot per sphere takes more from more spheres, one that they share does not.
width = 17; height = 7.5
load style
load tools.'/particle-checks/panels.gpi'
set multiplot
set bmargin at screen low(1, 1); set tmargin at screen high(1, 1)
set xrange [0:0.5]; set yrange [0:0.24]; set xtics 0.1; set format x '%.1f'
set xlabel 'time (s)'; set ylabel 'way (mm)'; set format y '%.2f'
set key at graph 0.03,0.98 left top
of(s, n) = rows('slide', sprintf('$1 == "spheres" && $2 == "%s" && $3 == %d', s, n))
set lmargin at screen left(1, 3); set rmargin at screen right(1, 3)
set label 1 letter(1) at graph 0,1.06
plot for [k=1:4] of('printed', 2*k+1) using 7:($8*1000) with lines lw 1.4 lc rgb tone[k] title sprintf('%d spheres', 2*k+1), \
     of('printed-half', 9) using 7:($8*1000) with lines lw 1.4 dt (6,3) lc rgb tone[4] title '9, half the damping'
unset label 999
set lmargin at screen left(2, 3); set rmargin at screen right(2, 3)
set label 1 letter(2); set ylabel 'way (m)'; set format y '%.1f'; set yrange [0:0.65]; set ytics 0.1
plot of('each', 3) using 7:9 with lines lw 1.2 lc rgb ink title 'theory', \
     for [k=1:4] of('each', 2*k+1) using 7:8 every 24::(6*k-3) with points pt 2*k+2 ps 0.8 lc rgb tone[k] title sprintf('%d, each', 2*k+1), \
     for [k=1:4] of('shared', 2*k+1) using 7:8 every 24::(6*k) with points pt 2*k+3 ps 0.7 lc rgb tone[k] title sprintf('%d, shared', 2*k+1)
set lmargin at screen left(3, 3); set rmargin at screen right(3, 3)
set label 1 letter(3); set ylabel 'rebound / impact speed'; set xlabel 'spheres that touch'
set xrange [0.5:9.5]; set xtics 1; set format x '%g'; set yrange [0:1]; set ytics 0.2
set key at graph 0.98,0.98 right top samplen 1
plot rows('landing', '$1 == "each"') using 2:3 with linespoints pt 7 ps 0.8 lw 1.2 lc rgb thesis title 'each its dashpot', \
     rows('landing', '$1 == "shared"') using 2:3 with linespoints pt 5 ps 0.8 lw 1.2 lc rgb ours title 'one shared'
unset multiplot
