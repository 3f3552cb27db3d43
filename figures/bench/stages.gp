# title: Time per stage
# needs: bench-stages.csv
# caption: Nanoseconds per sphere and step, one thread. Bodies: gather of the loads, kick and drift; contacts: narrow phase, law and its history; neighbours: list of pairs, its renewal spread over all steps; measure: guards; walls: places of moving parts.
width = 16; height = 8.5
load style
load tools.'/bench/machine.gpi'
set style data histograms
set style histogram rowstacked
set boxwidth 0.6
set xtics scale 0
set xrange [-0.6:5.6]
set bmargin at screen up(1.2)
set ylabel 'ns per sphere and step'
set yrange [0:*]
set lmargin at screen across(1.9)
set key outside right top vertical reverse Left invert width -2
set rmargin at screen 1 - across(3.4)
plain = "< awk -F, 'NR == 1 || ($2 == 1 && $1 !~ /^G/)' '".data."/bench-stages.csv'"
plot plain using 7:xtic(1) every ::1 title 'contacts' lc rgb ours, \
     '' using 4 every ::1 title 'bodies' lc rgb frictional, \
     '' using 6 every ::1 title 'neighbours' lc rgb '#E69F00', \
     '' using 5 every ::1 title 'walls' lc rgb thesis, \
     '' using ($8 + $9) every ::1 title 'measure, rest' lc rgb faint
