# title: A blow off the centre
# counterpart: A00 Figs 3.14 and 3.15
# needs: blow.csv
# caption: 1 kN for one step of 8.61 µs, 1.5 cm off the centre; no gravity. (a) Height of the centre and (b) angle against time: before the surface is met the slopes are 0.3543 m/s and 5.315 rad/s; then they depend on its damping. The surface is 5 cm away (assumed).
width = 17; height = 7.5
load style
load tools.'/particle-checks/panels.gpi'
array damping[3] = [0, 0.1, 0.21]
of(d) = rows('blow', sprintf('$1 == %g', d))
set multiplot
set bmargin at screen low(1, 1); set tmargin at screen high(1, 1)
set xrange [0:0.3]; set xtics 0.1; set xlabel 'time (s)'
set lmargin at screen left(1, 2); set rmargin at screen right(1, 2)
set label 1 letter(1) at graph 0,1.06
set ylabel 'height (mm)'
set key at graph 0.03,0.05 left bottom
plot for [k=1:3] of(damping[k]) using 2:($3*1000) with lines lw 1.4 dt k lc rgb tone[2*k-1] title sprintf('damping %g', damping[k])
unset label 999
set lmargin at screen left(2, 2); set rmargin at screen right(2, 2)
set label 1 letter(2); set ylabel 'angle (degrees)'
set key at graph 0.03,0.05 left bottom
plot for [k=1:3] of(damping[k]) using 2:($4*180/pi) with lines lw 1.4 dt k lc rgb tone[2*k-1] title sprintf('damping %g', damping[k])
unset multiplot
