# title: Points at which two particles touch
# counterpart: A00 Fig. 5.6
# needs: subcontacts.csv
# caption: Share of the touching pairs that do so at one, two, three or more of their spheres: line contacts, which count once in the co-ordination number. Bed at rest, one run per shape.
width = 8.2; height = 6.2
load style
load tools.'/aspect-ratio-hopper/aspect.gpi'
array tone[4] = ['#0b3c5d', '#4a7fa7', '#9cc3de', '#dbe9f4']
set style data histograms
set xlabel 'aspect ratio'; set ylabel 'pairs (%)'
set yrange [0:100]; set xrange [0.4:4.6]; set xtics 1
set key at screen 0.5,1 - up(0.12) center top maxrows 1 samplen 0.8 width -3 font small
set tmargin at screen 1 - up(0.9)
share(k, n) = number(system(sprintf("awk -F, '$1 == %d && $2 == %d { print $3 }' '%s/subcontacts.csv'", k, n, data)))
set boxwidth 0.6
plot '+' using (int($0) + 1):(100) every ::0::3 with boxes lc rgb tone[4] title 'more', \
     '+' using (int($0) + 1):(share(int($0) + 1, 1) + share(int($0) + 1, 2) + share(int($0) + 1, 3)) every ::0::3 with boxes lc rgb tone[3] title 'three', \
     '+' using (int($0) + 1):(share(int($0) + 1, 1) + share(int($0) + 1, 2)) every ::0::3 with boxes lc rgb tone[2] title 'two', \
     '+' using (int($0) + 1):(share(int($0) + 1, 1)) every ::0::3 with boxes lc rgb tone[1] title 'one point'
