# title: Mean residence time against the step
# counterpart: S12 Fig. 3.16
# needs: residence.csv
# caption: Left: mean residence time of the tracers, weighted by mass (S12 3.58), mean over the initial states with its 95 % interval; the five steps up to 0.8 ms, then on to where runs stop. Right: what the methods differ by in the same initial state; grey: the twentieth that counts as equal. The source's curve stands in its figure alone. The leapfrog is the engine's own method, of the same equations as position Verlet: they part by rounding.
width = 17; height = 9
load style
load tools.'/hopper-discharge/discharge.gpi'
set multiplot
set xrange [0:1.8]; set xtics 0.4; set xlabel 'time step, ms'
set tmargin at screen 1 - up(2.2)
set x2tics ('32' 0.1, '8' 0.4, '4' 0.8, '2.7' 1.2, '2' 1.6) out scale 0.5 tc rgb ink
set x2range [0:1.8]; set x2label 'steps in the shortest contact' tc rgb ink offset 0,-0.3
set key at screen 0.5,1 - up(0.1) center top maxrows 1
set lmargin at screen across(1.8); set rmargin at screen 0.5 - across(0.1)
set ylabel 'mean residence time, s'; set format y '%.2f'
shift(m) = 0.015 * (m - 2)
plot for [m=1:3] of('residence', m) using (1e3 * $2 + shift(m)):5:(spread($6)) with yerrorbars pt marks[m] ps 0.7 lw 1.1 lc rgb tints[m] title words[m]
unset label 999; unset key
set lmargin at screen 0.5 + across(1.8); set rmargin at screen 1 - across(0.35)
set ylabel 'residence time over position Verlet’s'
set yrange [0.9:1.1]
set object 1 rectangle from graph 0, first 0.95 to graph 1, first 1.05 fc rgb '#f0f0f0' fs solid noborder behind
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead lw 0.7 lc rgb faint
plot of('residence', 1) using (1e3 * $2 - 0.012):9:(spread($10)) with yerrorbars pt marks[1] ps 0.7 lw 1.1 lc rgb tints[1], \
     of('residence', 3) using (1e3 * $2 + 0.012):9:(spread($10)) with yerrorbars pt marks[3] ps 0.7 lw 1.1 lc rgb tints[3]
unset multiplot
