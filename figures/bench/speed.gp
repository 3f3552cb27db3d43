# title: Speed against peers
# counterpart: DESIGN §8
# needs: bench-peers.csv
# caption: Million sphere-steps per second, medians of runs in turn on one machine. All codes start from the same state and run the same contact law but for the last bar (LAMMPS gran/hertz/history, a simpler law). Above our bars: the ratio to the fastest peer with the same law. LAMMPS has no meshes (D). Clast runs with its energy ledger and guards on; "SSE2" is the same program held to baseline instructions, which is what Debian's builds of the peers use.
width = 16; height = 13
load style
load tools.'/bench/machine.gpi'
set style data histograms
set style histogram clustered gap 1.2
set boxwidth 0.92 relative
codes = 'clast/full;clast baseline/full;lammps/full;liggghts/full;lammps/simple'
table(cores) = sprintf("< awk -v cores=%d -v column=8 -v codes='%s' -v peers='3 4' -v scenes='A20k,A100k,B,C2,C4,D' -f '%s/bench/pivot.awk' '%s/bench-peers.csv'", cores, codes, tools, data)
set xtics scale 0
set xrange [-0.7:5.7]
set ylabel 'million sphere-steps per second'
set yrange [0:*]; set offsets 0, 0, graph 0.06, 0
set multiplot
do for [cores=1:2] {
    set tmargin at screen (cores == 1 ? 0.91 : 0.475); set bmargin at screen (cores == 1 ? 0.545 : 0.11)
    if (cores == 1) { set key horizontal at screen 0.54, 0.99 center top samplen 1.2 width -1 } else { unset key }
    set label 1 (cores == 1 ? 'one core' : 'two cores') at graph 0.005, 0.94 left tc rgb ink
    plot table(cores) using 2:xtic(1) title 'Clast' lc rgb ours, \
         '' using 3 title 'Clast, SSE2' lc rgb ours_light, \
         '' using 4 title 'LAMMPS' lc rgb thesis, \
         '' using 5 title 'LIGGGHTS' lc rgb frictional, \
         '' using 6 title 'LAMMPS, simpler law' lc rgb '#f0c9a8', \
         '' using ($0 - 0.32):2:7 with labels offset 0, 0.6 font small tc rgb ours notitle
    set label 999 ''
}
unset multiplot
