# title: What the agreement score is worth
# counterpart: none, the source has no such study
# needs: null.csv null_summary.csv
# caption: Mean score of ten particles when there is nothing to disagree about: one more experiment (upper) or the exact mean of all experiments (lower) against an ensemble of five. Two extremes of normal draws, independent from frame to frame or one draw for a whole track, and our own replicates, five of which are the ensemble. Vermilion: the mean score of the thesis, 82 %; dotted: ours.
width = 17; height = 11
load style
array kind_of[2] = ['new draw', 'exact mean']
array name_of[2] = ['one more experiment', 'the exact mean']
array how[3] = ['independent', 'whole track', 'our replicates']
array words[3] = ['independent frames', 'one draw for a whole track', 'our replicates']
array tint[3] = [faint, frictional, ours]
own = system(sprintf("sed -n 's/^mean_score=//p' '%s/about.txt'", data)) + 0
set multiplot
set xrange [0:101]; set xtics 10; set yrange [0:0.75]; set ytics 0.25; set lmargin at screen across(1.8)
do for [i=1:2] {
    set tmargin at screen 1 - up(i == 1 ? 0.9 : 5.5); set bmargin at screen 1 - up(i == 1 ? 4.7 : 9.3)
    set xlabel (i == 2 ? 'mean score (%)' : ''); set ylabel 'part of the draws'
    set label 1 name_of[i] at graph 0.02,0.9 tc rgb ink
    set arrow 1 from 82.0, graph 0 to 82.0, graph 1 nohead lw 1.4 lc rgb thesis
    set arrow 2 from own, graph 0 to own, graph 1 nohead lw 1.2 dt 3 lc rgb experiment
    if (i == 1) { set key at screen 0.5,1 - up(0.05) center top maxrows 1 } else { unset key; unset label 999 }
    plot for [k=1:3] rows('null', sprintf('$1 == "%s" && $2 == "%s"', kind_of[i], how[k])) \
         using 3:4 with histeps lw 1.5 lc rgb tint[k] title words[k]
}
unset multiplot
