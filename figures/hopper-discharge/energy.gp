# title: Energy made and spheres lost against the step
# counterpart: none, our own measurement
# needs: flows.csv
# caption: One mark per run. Left: largest error of the total energy at any time, of what the bed holds at the start (height above the orifice and springs); line: 5 %, what the engine's guard lets pass. Right: spheres wholly behind a wall at the end. A thin wall of the printed stiffness lets a few through at any step; a run that stops early (crosses) has not lost all that it would.
width = 17; height = 8.5
load style
load tools.'/hopper-discharge/discharge.gpi'
set multiplot
set xlabel 'time step, ms'; set xrange [0:2.1]
set tmargin at screen 1 - up(1.2)
set lmargin at screen across(1.9); set rmargin at screen 0.5 - across(0.1)
set logscale y; set yrange [3e-4:1]; set format y '10^{%T}'
set ylabel 'energy error / energy of the bed'
set key at screen 0.5,1 - up(0.1) center top maxrows 1
set arrow 1 from graph 0, first 0.05 to graph 1, first 0.05 nohead lw 0.8 lc rgb faint
usual(m, more) = rows('flows', sprintf('$1 == "%s" && $2 == 0 && %s', method[m], more))
plot for [m=1:3] usual(m, '1') using (1e3 * $3 + 0.015 * (m - 2)):8 with points pt marks[m] ps 0.7 lc rgb tints[m] title words[m]
unset label 999; unset key; unset arrow 1; unset logscale y
set lmargin at screen 0.5 + across(1.7); set rmargin at screen 1 - across(0.35)
set yrange [-0.5:*]; set format y '%g'; set ylabel 'spheres through walls'
plot for [m=1:3] usual(m, '$10 == ""') using (1e3 * $3 + 0.015 * (m - 2)):14 with points pt marks[m] ps 0.7 lc rgb tints[m], \
     for [m=1:3] usual(m, '$10 != ""') using (1e3 * $3 + 0.015 * (m - 2)):14 with points pt 2 ps 0.6 lc rgb tints[m]
unset multiplot
