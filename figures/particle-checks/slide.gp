# title: A capsule slides down 30 degrees
# counterpart: A00 Figs 3.7 to 3.9
# needs: slide.csv
# caption: Lines: theory; marks: Clast. (a) Five spheres, friction 0.1 to 0.5, no tangential dashpot. (b) Friction 0.3 and, as in the source, a tangential dashpot on top of it (a law of our own, law.c): at the source's damping 0.21 the particle sticks. (c) Nine spheres at three steps, in parts of the critical one: the source's steps drift apart, these do not. Frictions of (a), dampings of (b) and steps of (c) are ours where the source has them in figures alone.
width = 17; height = 7.5
load style
load tools.'/particle-checks/panels.gpi'
set multiplot
set bmargin at screen low(1, 1); set tmargin at screen high(1, 1)
set xrange [0:0.5]; set yrange [0:0.55]; set xtics 0.1; set format x '%.1f'; set format y '%.1f'
set xlabel 'time (s)'; set ylabel 'way (m)'
set key at graph 0.03,0.98 left top
set lmargin at screen left(1, 3); set rmargin at screen right(1, 3)
set label 1 letter(1) at graph 0,1.06
of(f, c) = rows('slide', sprintf('$1 == "%s" && %s', f, c))
plot for [k=1:5] of('friction', sprintf('$4 == %g', 0.1*k)) using 7:9 with lines lw 1.2 lc rgb tone[k] notitle, \
     for [k=1:5] of('friction', sprintf('$4 == %g', 0.1*k)) using 7:8 every 8 with points pt 6 ps 0.7 lc rgb tone[k] title sprintf('μ = %.1f', 0.1*k)
unset label 999
array slip[5] = [0, 0.0001, 0.001, 0.01, 0.21]
set lmargin at screen left(2, 3); set rmargin at screen right(2, 3)
set label 1 letter(2); set ylabel ''; set yrange [0:0.4]; set ytics 0.1
plot of('damping', '$5 == 0') using 7:9 with lines lw 1.2 lc rgb tone[1] notitle, \
     for [k=1:5] of('damping', sprintf('$5 == %g', slip[k])) using 7:8 every 4 with points pt 6 ps 0.6 lc rgb tone[k] title sprintf('damping %g', slip[k])
array part[3] = [1, 0.5, 0.1]
set lmargin at screen left(3, 3); set rmargin at screen right(3, 3)
set label 1 letter(3)
plot of('step', '$6 == 1') using 7:9 with lines lw 1.2 lc rgb ink title 'theory', \
     for [k=1:3] of('step', sprintf('$6 == %g', part[k])) using 7:8 every 9::(3*k) with points pt 4+2*k ps 0.8 lc rgb tone[2*k-1] title sprintf('step %g', part[k])
unset multiplot
