# title: Cost against size
# needs: bench-scaling.csv bench-machine.csv
# caption: Beds like A from a thousand to a million spheres at rest. Above: time per sphere and step; the dashed lines mark where the engine's memory fills the caches of one core. Below: seconds to build and read the settled state, for the first step with everything it prepares, and to write one frame.
width = 12; height = 13
load style
load tools.'/bench/machine.gpi'
row(t) = sprintf("< awk -F, 'NR > 1 && $3 == %d' '%s/bench-scaling.csv'", t, data)
cache(level) = number(system(sprintf("awk -F, '$1 == \"%s_bytes\" { print $2 }' '%s/bench-machine.csv'", level, data)))
each = number(system(sprintf("awk -F, 'NR > 1 { v = $10 } END { print v }' '%s/bench-scaling.csv'", data)))
set logscale x
set xrange [700:1.5e6]
set format x '10^{%T}'
set multiplot
set tmargin at screen 0.925; set bmargin at screen 0.55
set ylabel 'ns per sphere and step'
set yrange [0:*]
set key horizontal at screen 0.56, 0.995 center top samplen 1.5
array level[3] = ['l1d', 'l2', 'l3']; array said[3] = ['L1', 'L2', 'L3']
do for [i=1:3] {
    at = cache(level[i]) / each
    if (at > 700 && at < 1.5e6) {
        set arrow i from at, graph 0 to at, graph 1 nohead dt (4,4) lw 0.8 lc rgb faint
        set label i said[i] at at, graph 0.96 left offset 0.4, 0 font small tc rgb faint
    }
}
plot row(1) using 2:4 with linespoints pt 7 ps 0.8 lw 1.2 lc rgb ours title 'one thread', \
     row(2) using 2:4 with linespoints pt 6 ps 0.8 lw 1.2 dt (6,3) lc rgb ours title 'up to two threads', \
     row(1) using 2:5 with linespoints pt 9 ps 0.7 lw 1 lc rgb '#E69F00' title 'of it lists, one thread'
set label 999 ''
do for [i=1:3] { unset arrow i; unset label i }
set tmargin at screen 0.47; set bmargin at screen 0.12
set logscale y; set yrange [*:*]; set format y '10^{%T}'
set ylabel 'seconds'; set xlabel 'spheres'
set key vertical at graph 0.02, 0.98 left top
plot row(1) using 2:6 with linespoints pt 7 ps 0.7 lw 1 lc rgb ours title 'load', \
     row(1) using 2:7 with linespoints pt 9 ps 0.7 lw 1 lc rgb thesis title 'first step', \
     row(1) using 2:8 with linespoints pt 5 ps 0.7 lw 1 lc rgb frictional title 'write a frame'
unset multiplot
