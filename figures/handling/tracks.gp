# title: Ways of the particles over the two conveyors
# counterpart: A00 Figs 3.25 and 3.26
# needs: tracks.csv
# caption: Centroids of the tapered (left) and of the irregular particle (right), one line per run: orientations at the start are random. Black: the walls; arrows: which way the belts run. The figures of the source are snapshots of one run each.
width = 17; height = 7.8
load style
way(scene, k) = rows('tracks', sprintf('$1 == "%s" && $2 == %d', scene, k))
set multiplot
set size ratio -1
set border 3
set xrange [-1:61]; set yrange [-2:60]
set xtics 10; set ytics 10
set xlabel 'x (cm)'
do for [p=1:2] {
    scene = p == 1 ? 'tapered' : 'irregular'
    level = p == 1 ? 30 : 40
    if (p == 2) { unset label 999 }
    set lmargin at screen across(p == 1 ? 1.5 : 10.0); set rmargin at screen across(p == 1 ? 8.2 : 16.7)
    set bmargin at screen up(1.55); set tmargin at screen 1 - up(0.3)
    set ylabel (p == 1 ? 'z (cm)' : '')
    set label 1 (p == 1 ? 'tapered, (a)' : 'irregular, (b)') at 58,56 right tc rgb ink
    set arrow 1 from 0,level to 30,level nohead lw 2.5 lc rgb experiment
    set arrow 2 from 59,level to 60,level nohead lw 2.5 lc rgb experiment
    set arrow 3 from 0,0 to 60,0 nohead lw 2.5 lc rgb experiment
    set arrow 4 from 0,0 to 0,60 nohead lw 1.2 lc rgb experiment
    set arrow 5 from 60,0 to 60,60 nohead lw 1.2 lc rgb experiment
    set arrow 6 from 12,level - 3 to 24,level - 3 size screen 0.012,20 filled lw 1.2 lc rgb thesis
    set arrow 7 from 36,3 to 24,3 size screen 0.012,20 filled lw 1.2 lc rgb thesis
    plot for [k=1:40] way(scene, k) using 5:7 with lines lw 0.7 lc rgb ours_light, \
         way(scene, 1) using 5:7 with lines lw 1.8 lc rgb ours
}
unset multiplot
