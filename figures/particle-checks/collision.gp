# title: Upright and lying
# counterpart: A00 Fig. 3.3
# needs: collision.csv
# caption: Two spheres dropped from 10 mm (assumed), damping 0.1, step 1 µs, every sphere that touches with a dashpot of its own. (a) Height of the lowest point; (b) force of the first collision in all and per contact. The lying particle loses more and bounces lower, where the source says higher; with one dashpot for both spheres it bounces as the upright one.
width = 17; height = 7.5
load style
load tools.'/particle-checks/panels.gpi'
of(o) = rows('collision', sprintf('$1 == "%s" && $6 != 1', o)); first(o) = rows('collision', sprintf('$1 == "%s" && $6 == 1 && $4 > 0', o))
all(o) = rows('collision', sprintf('$1 == "%s"', o))
set multiplot
set bmargin at screen low(1, 1); set tmargin at screen high(1, 1)
set lmargin at screen left(1, 2); set rmargin at screen right(1, 2)
set label 1 letter(1) at graph 0,1.06
set xlabel 'time (ms)'; set ylabel 'height (mm)'; set xrange [0:180]; set xtics 40; set yrange [-0.3:10.5]
plot all('shared') using ($2*1000):($3*1000) with lines lw 5 lc rgb ours_pale title 'lying, shared', \
     all('vertical') using ($2*1000):($3*1000) with lines lw 1.4 lc rgb ours title 'upright', \
     all('horizontal') using ($2*1000):($3*1000) with lines lw 1.4 dt (6,3) lc rgb thesis title 'lying'
unset label 999
set lmargin at screen left(2, 2); set rmargin at screen right(2, 2)
set label 1 letter(2)
set xlabel 'time from the touch (µs)'; set ylabel 'force (N)'; set xrange [0:110]; set yrange [0:480]; set xtics 20
start(o) = system(sprintf("awk -F, '$1 == \"%s\" && $6 == 1 && $4 > 0 { print $2; exit }' '%s/collision.csv'", o, data)) + 0
v = start('vertical'); h = start('horizontal')
plot first('vertical') using (($2-v)*1e6):4 with lines lw 1.4 lc rgb ours title 'upright', \
     first('horizontal') using (($2-h)*1e6):4 with lines lw 1.4 dt (6,3) lc rgb thesis title 'lying, both contacts', \
     first('horizontal') using (($2-h)*1e6):5 with lines lw 1.4 dt (2,3) lc rgb thesis title 'lying, each'
unset multiplot
