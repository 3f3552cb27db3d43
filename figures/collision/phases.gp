# title: Loading and unloading
# counterpart: S12 Fig. 2.15
# needs: curves.csv
# caption: Overlap, rate and force of a linear contact with restitution 0.5, each over its largest value. Loading ends where the rate changes its sign; the force begins with the dashpot's and is largest before that. Lines: closed form; marks: Clast, which has no contact yet at the touch itself.
width = 12; height = 7.5
load style
load tools.'/collision/curves.gpi'
T = most('phases', 4); D = most('phases', 5); V = most('phases', 6); F = most('phases', 7)
turn = system(sprintf("awk -F, '$1 == \"phases\" && $3 == \"theory\" && $6 > 0 { t = $4 } END { print t }' '%s/curves.csv'", data)) / T
set xlabel 'time / duration'; set ylabel 'over the largest'
set xrange [0:1.02]; set yrange [-0.6:1.1]; set format y '%.1f'
set xzeroaxis lt 1 lw 0.5 lc rgb faint
set arrow 1 from first turn, graph 0 to first turn, graph 1 nohead lw 0.7 dt (4,3) lc rgb faint
set label 1 'loading' at first turn / 2, graph 0.05 center tc rgb faint
set label 2 'unloading' at first (1 + turn) / 2, graph 0.05 center tc rgb faint
set tmargin at screen 1 - up(0.9); set key at screen 0.56,1 - up(0.12) center top maxrows 1
plot theory('phases', '0.5') using ($4/T):($5/D) with lines lw 1.4 lc rgb ours title 'overlap', \
     theory('phases', '0.5') using ($4/T):($6/V) with lines lw 1.4 lc rgb thesis title 'rate', \
     theory('phases', '0.5') using ($4/T):($7/F) with lines lw 1.4 lc rgb frictional title 'force', \
     engine('phases', '0.5') using ($4/T):($7/F) with points pt 6 ps 0.6 lc rgb frictional, \
     engine('phases', '0.5') using ($4/T):($5/D) with points pt 6 ps 0.6 lc rgb ours, \
     engine('phases', '0.5') using ($4/T):($6/V) with points pt 6 ps 0.6 lc rgb thesis
