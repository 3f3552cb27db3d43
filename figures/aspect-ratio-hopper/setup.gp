# title: The hopper, its chamber, and where it is looked at
# counterpart: A00 Figs 5.1 and 5.10
# needs: tracks.csv pressure.csv
# caption: To scale. The orifice is 70 % of the width, the chamber twice as deep as the hopper is wide; its side walls are those of the hopper (A00 2.5.3). Left: the ten partitions of the side wall, tenths of the height H of the bed at rest. Dots: the nine particles that are followed. Right: the three regions of the energy ratio.
width = 8.2; height = 9.6
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
slot = 0.7 * side; ground = -4 * side
stats shape('tracks', 1) using 6 every ::0::0 nooutput
H = number(system(sprintf("awk -F, '$1 == \"bed height\" && $3 == 1 { print 100 * $7 }' '%s/facts.csv'", data)))
set size ratio -1
unset grid; unset border; unset tics
set lmargin at screen 0.2; set rmargin at screen 0.98; set bmargin at screen up(0.5); set tmargin at screen 1 - up(0.1)
set xrange [-2.3 * side:2.3 * side]; set yrange [ground - 0.15 * side:4.6 * side]
set object 1 rectangle from -side,0 to side,H fs solid 1 noborder fc rgb '#eeeeee' behind
set arrow 1 from -side,ground to -side,4.5 * side nohead lw 2 lc rgb experiment
set arrow 2 from side,ground to side,4.5 * side nohead lw 2 lc rgb experiment
set arrow 3 from -side,ground to side,ground nohead lw 2 lc rgb experiment
set arrow 4 from -side,0 to -slot,0 nohead lw 4 lc rgb experiment
set arrow 5 from slot,0 to side,0 nohead lw 4 lc rgb experiment
do for [k=0:10] { set arrow 20 + k from -side,0.1 * k * H to -1.08 * side,0.1 * k * H nohead lw 1 lc rgb thesis }
do for [k=1:2] { set arrow 40 + k from (2 * k - 3) * side / 3,0 to (2 * k - 3) * side / 3,H nohead lw 0.8 dt (4,4) lc rgb faint }
set arrow 50 from 1.2 * side,0 to 1.2 * side,H heads size screen 0.012,20 lw 0.9 lc rgb ink
set label 50 'H' at 1.28 * side,0.5 * H left tc rgb ink font small
set arrow 51 from -slot,-0.25 * side to slot,-0.25 * side heads size screen 0.012,20 lw 0.9 lc rgb ink
set label 51 "orifice, 0.7\nof the width" at 0,-0.5 * side center tc rgb ink font small
set arrow 52 from 1.2 * side,ground to 1.2 * side,0 heads size screen 0.012,20 lw 0.9 lc rgb ink
set label 52 sprintf('%g m', -0.01 * ground) at 1.28 * side,0.5 * ground left tc rgb ink font small
set label 53 'ten partitions' at -1.15 * side,0.5 * H right tc rgb thesis font small
do for [k=0:2] { set label 60 + k word('left centre right', k + 1) at (2 * k - 2) * side / 3,H + 0.14 * side center tc rgb faint font small }
plot rows('tracks', '$1 == "1" && $4 == 0') using 5:6 with points pt 7 ps 0.8 lc rgb ours
