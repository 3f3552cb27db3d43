# title: Spheres on the rotating disc
# counterpart: none, the source shows no result of this input
# needs: tracks.csv turntable.csv
# caption: Left: ways of the fifteen spheres from above, dots where they start, colour by sphere. Right: one sphere alone, the disc cut into more and more cells of constant velocity; where it rolls on a true disc it runs in a circle with 2/7 of the spin. Square: the partition that turns; frame: the box.
width = 17; height = 9.2
load style
set multiplot
set size ratio -1
set xrange [-70:70]; set yrange [-70:70]
set xtics 20; set ytics 20
set border 15 lw 1.2 lc rgb experiment
unset grid
set object 1 rectangle from -50,-50 to 50,50 behind fs empty border lc rgb faint lw 1
set xlabel 'x (cm)'
set bmargin at screen up(1.6); set tmargin at screen 1 - up(0.9)
set lmargin at screen across(1.5); set rmargin at screen across(8.2)
set ylabel 'y (cm)'
ball(b) = rows('tracks', sprintf('$1 == "disc" && $3 == %d', b))
hue(b) = hsv2rgb(b / 15.0, 0.75, 0.75)
plot for [b=0:14] ball(b) using 5:6 with lines lw 0.7 lc rgb hue(b), \
     for [b=0:14] ball(b) using ($4 == 0 ? $5 : NaN):6 with points pt 7 ps 0.7 lc rgb hue(b)
unset label 999
set lmargin at screen across(10.0); set rmargin at screen across(16.7)
set ylabel ''
set key at screen across(13.35),1 - up(0.1) center top maxrows 2 samplen 1.5
alone(name) = rows('turntable', sprintf('$1 == "%s"', name))
cells = system(sprintf("sed -n 's/^cells=//p' '%s/about.txt'", data))
plot alone('8 x 8 cells') using 5:6 with lines lw 0.8 lc rgb colour[5] title '8 × 8 cells', \
     alone('16 x 16 cells') using 5:6 with lines lw 0.8 lc rgb colour[4] title '16 × 16', \
     alone('as cut') using 5:6 with lines lw 1.2 lc rgb colour[2] title cells.' × '.cells, \
     alone('64 x 64 cells') using 5:6 with lines lw 1.2 lc rgb colour[1] title '64 × 64'
unset multiplot
