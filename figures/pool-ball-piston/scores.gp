# title: Agreement scores
# counterpart: A00 Table 4.2
# needs: scores.csv null_summary.csv
# caption: Part of the points of A00 4.3 that each particle gets. Vermilion: the source's model against its experiment. Blue: our model against an ensemble of five replicates of our own model; hollow: against five at the measured static friction. These are not the experiment, whose tracks stand only in figures, and particles are numbered in another order. Lines: what a perfect new draw (53 %) and the exact mean (88 %) get against an ensemble of five.
width = 17; height = 8.2
load style
set xrange [0.4:10.6]; set yrange [0:100]
set xtics 1; set xlabel 'particle'; set ylabel 'agreement score (%)'
set tmargin at screen 1 - up(1.1); set rmargin at screen 1 - across(2.9)
set key at screen 0.5,1 - up(0.1) center top maxrows 1 width -9
level(kind) = system(sprintf("awk -F, '$1 == \"%s\" && $2 == \"independent\" { print $3 }' '%s/null_summary.csv'", kind, data)) + 0
new = level('new draw'); exact = level('exact mean')
set label 1 'exact mean' at graph 1.01,first exact tc rgb faint
set label 2 'new draw' at graph 1.01,first new tc rgb faint
plot exact with lines lw 0.8 dt 2 lc rgb faint notitle, new with lines lw 0.8 dt 2 lc rgb faint notitle, \
     rows('scores', '1') using ($1-0.15):8 with points pt 5 ps 1.0 lc rgb thesis title 'thesis', \
     rows('scores', '1') using ($1):6 with points pt 7 ps 1.1 lc rgb ours title 'ours', \
     rows('scores', '1') using ($1+0.15):7 with points pt 6 ps 1.1 lw 1.1 lc rgb ours title 'ours, against static friction'
