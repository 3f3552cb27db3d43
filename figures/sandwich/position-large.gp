# title: A ball between two walls, 1 ms per step
# counterpart: S12 Fig. 3.7 (right)
# needs: positions.csv
# caption: 5.2 steps per contact. Right, where the source looks, position Verlet seems to be a third of a period behind. Left, where it begins: it runs ahead, by 0.101 rad per period (theory: 2 asin(h/2) > h), which is 4.4 rad after 0.45 s; minus a whole period, that looks like a delay of 1.9 rad.
width = 17; height = 8
load style
load tools.'/sandwich/sandwich.gpi'
T = 0.45
set multiplot
set yrange [-1.15:1.15]; set xlabel 'time / 0.45 s'
set xzeroaxis lt 1 lw 0.5 lc rgb faint
set tmargin at screen 1 - up(0.9)
do for [i=1:2] {
    from = i == 1 ? 0 : 0.4; to = i == 1 ? 0.05 : T
    set xrange [from/T:to/T]; set format x '%.2f'
    set lmargin at screen (i == 1 ? across(1.6) : 0.5 + across(1.0)); set rmargin at screen (i == 1 ? 0.5 : 1 - across(0.4))
    set ylabel (i == 1 ? 'position / position at the start' : '')
    if (i == 2) { unset label 999; unset key } else { set key at screen 0.53,1 - up(0.1) center top maxrows 1 }
    plot exact(from, to) using ($3/T):4 with lines lw 1.6 lc rgb experiment title 'exact (S12 3.56)', \
         at(1e-3, verlet, from, to) using ($3/T):4 with linespoints pt 6 ps 0.8 lw 0.8 lc rgb verlet_tint title 'position Verlet', \
         at(1e-3, numerov, from, to) using ($3/T):4 with linespoints pt 2 ps 0.7 lw 0.8 dt 3 lc rgb numerov_tint title 'Numerov'
}
unset multiplot
