# title: The particles
# counterpart: A00 Figs 3.10 and 3.16
# needs: particles.csv
# caption: (a) One solid, aspect ratio 3, as 3, 5, 7 and 9 spheres for the slope. (b) Pseudo-friction at q = 1, 2 and 4 spheres per diameter, aspect ratio 5: three particles cover the bottom of a box, the fourth starts in the first nest; the slope falls to the right.
width = 17; height = 8.5
load style
load tools.'/particle-checks/panels.gpi'
of(f, n) = rows('particles', sprintf('$1 == "%s" && $2 == %g', f, n))
set multiplot
unset border; unset tics; unset grid; unset key
set style fill transparent solid 0.25 border lc rgb ours
set lmargin at screen 0.02; set rmargin at screen 0.27
set bmargin at screen up(0.6); set tmargin at screen high(1, 1)
set size ratio -1
set label 1 letter(1) at screen across(0.4),1 - up(0.45)
set label 2 letter(2) at screen 0.31,1 - up(0.45)
set xrange [-3.4:3.4]; set yrange [-0.3:10.9]
do for [k=1:4] { set label 10+k sprintf('%d', 2*k+1) at first -3.3,12.2-2.8*k right tc rgb ink }
plot for [k=1:4] of('slide', 2*k+1) using ($3*100):($4*100+11.2-2.8*k):($5*100) with circles lc rgb ours
unset label 999; unset label 1; unset label 2
do for [k=1:4] { unset label 10+k }
set lmargin at screen 0.33; set rmargin at screen 0.99
set xrange [-1:31]; set yrange [0.2:16.4]
array q[3] = [1, 2, 4]
do for [k=1:3] { set label 10+k sprintf('q = %d', q[k]) at first 16,16.2-5.6*(k-1) tc rgb ink }
plot for [k=1:3] of('row', q[k]) using ($3*100):($4*100+11.9-5.6*(k-1)):($5*100) with circles fc rgb faint lc rgb faint, \
     for [k=1:3] of('upper', q[k]) using ($3*100):($4*100+11.9-5.6*(k-1)):($5*100) with circles lc rgb ours
unset multiplot
