# title: What a step costs
# counterpart: A00 Tables 3.5 and 3.6
# needs: runtime.csv
# caption: 200 particles of aspect ratio 2 fall into a box and come to rest, with 2 to 17 spheres each, and as many single spheres as in the first three cases. Processor time per step, (a) per sphere, (b) per particle; the source's on a K6 of 380 MHz, another code and another machine: only the trends compare.
width = 17; height = 7.5
load style
load tools.'/particle-checks/panels.gpi'
set multiplot
set bmargin at screen low(1, 1); set tmargin at screen high(1, 1)
set logscale y; set yrange [0.01:2000]; set format y '%g'
set lmargin at screen left(1, 2); set rmargin at screen right(1, 2)
set label 1 letter(1) at graph 0,1.06
set logscale x; set xrange [300:4500]; set xtics (400, 600, 1000, 1800, 3400)
set xlabel 'spheres in all'; set ylabel 'µs per sphere'
set key at graph 0.97,0.6 right center
clumps = rows('runtime', '$2 > 1'); singles = rows('runtime', '$2 == 1')
plot clumps using ($1*$2):9 with linespoints pt 4 ps 1 lw 1.2 lc rgb thesis title 'source, clumps', \
     singles using ($1*$2):9 with linespoints pt 6 ps 1 lw 1.2 dt (6,3) lc rgb thesis title 'source, spheres', \
     clumps using ($1*$2):3 with linespoints pt 5 ps 0.8 lw 1.2 lc rgb ours title 'Clast, clumps', \
     singles using ($1*$2):3 with linespoints pt 7 ps 0.8 lw 1.2 dt (6,3) lc rgb ours title 'Clast, spheres'
unset label 999
set lmargin at screen left(2, 2); set rmargin at screen right(2, 2)
set label 1 letter(2)
set xrange [1.7:20]; set xtics (2, 3, 5, 9, 17); set yrange [0.03:5000]
set xlabel 'spheres per particle'; set ylabel 'µs per particle'
plot clumps using 2:($9*$2) with linespoints pt 4 ps 1 lw 1.2 lc rgb thesis title 'source', \
     clumps using 2:4 with linespoints pt 5 ps 0.8 lw 1.2 lc rgb ours title 'Clast'
unset multiplot
