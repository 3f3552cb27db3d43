# title: Spheres on the rotating disc
# counterpart: none, the source shows no result of this input
# needs: tracks.csv
# caption: Left: ways of the fifteen spheres from above, dots where they start, colour by sphere; circle: the disc. Right: their distance from the axis. A sphere that is put down at rest and then rolls runs in a circle about the axis of the disc with 2/7 of its spin, whatever slipped before.
width = 17; height = 9.2
load style
set multiplot
set size ratio -1
set xrange [-55:55]; set yrange [-55:55]
set xtics 20; set ytics 20
set border 15 lw 1.2 lc rgb experiment
unset grid
set object 1 circle at 0,0 size 50 behind fs empty border lc rgb faint lw 1
set xlabel 'x (cm)'
set bmargin at screen up(1.6); set tmargin at screen 1 - up(0.9)
set lmargin at screen across(1.5); set rmargin at screen across(8.2)
set ylabel 'y (cm)'
ball(b) = rows('tracks', sprintf('$1 == "disc" && $3 == %d', b))
hue(b) = hsv2rgb(b / 15.0, 0.75, 0.75)
plot for [b=0:14] ball(b) using 5:6 with lines lw 0.7 lc rgb hue(b), \
     for [b=0:14] ball(b) using ($4 == 0 ? $5 : NaN):6 with points pt 7 ps 0.7 lc rgb hue(b)
unset label 999
unset object 1
set size noratio
set lmargin at screen across(10.0); set rmargin at screen across(16.7)
set xrange [0:6]; set yrange [0:20]
set xtics 1; set ytics 5
set xlabel "time (s)"; set ylabel "distance from the axis (cm)"
plot for [b=0:14] ball(b) using 4:(sqrt($5**2 + $6**2)) with lines lw 0.9 lc rgb hue(b)
unset multiplot
