# title: Instruction sets
# needs: bench-isa.csv
# caption: Million sphere-steps per second on one thread with the same program held to one instruction set; the states after the run are the same to the bit.
width = 12; height = 7.5
load style
load tools.'/bench/machine.gpi'
set style data histograms
set style histogram clustered gap 1.2
set boxwidth 0.92 relative
set xtics scale 0
set xrange [-0.7:5.7]
set bmargin at screen up(1.2)
pivot(isa) = sprintf("< awk -F, 'NR > 1 && $3 == \"%s\" && $1 !~ /^G/' '%s/bench-isa.csv'", isa, data)
set ylabel 'million sphere-steps per second'
set yrange [0:*]
set key top left
plot pivot('baseline') using 5:xtic(1) title 'SSE2' lc rgb ours_pale, pivot('avx2') using 5 title 'AVX2' lc rgb ours_light, \
     pivot('avx512') using 5 title 'AVX-512' lc rgb ours
