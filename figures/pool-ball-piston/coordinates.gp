# title: Positions of the best and the worst particle
# counterpart: A00 Fig. 4.7
# needs: limits.csv scores.csv
# caption: Position against time of the particle with the highest (left) and the lowest (right) agreement score. Pale: least and most of five replicates; darker: the 95 % interval of their mean; black: the model.
width = 17; height = 10.9
load style
load tools.'/pool-ball-piston/limits.gpi'
extreme(sign) = system(sprintf("awk -F, 'NR > 1 && (n == 0 || %d * $6 > %d * best) { best = $6; n = $1 } END { print n }' '%s/scores.csv'", sign, sign, data)) + 0
score_of(p) = system(sprintf("awk -F, '$1 == %d { printf \"%%.0f\", $6 }' '%s/scores.csv'", p, data))
array which[2] = [extreme(1), extreme(-1)]
set multiplot
do for [c=1:2] {
    p = which[c]
    do for [r=0:1] {
        set lmargin at screen across(c == 1 ? 1.7 : 10.0); set rmargin at screen across(c == 1 ? 8.2 : 16.6)
        set tmargin at screen 1 - up(0.8 + 4.6 * r); set bmargin at screen 1 - up(0.8 + 4.6 * r + 3.8)
        set xlabel (r == 1 ? 'time (s)' : ''); set ylabel (r == 0 ? 'x (cm)' : 'height (cm)')
        if (r == 0) { set label 1 sprintf('particle %d, score %s %%', p, score_of(p)) at graph 0.5,1.08 center tc rgb ink } else { unset label 1 }
        if (c + r > 1) { unset label 999 }
        plot item(r == 0 ? 'x' : 'z', p) using 3:6:7 with filledcurves fc rgb band, \
             item(r == 0 ? 'x' : 'z', p) using 3:($4-$5):($4+$5) with filledcurves fc rgb inner, \
             item(r == 0 ? 'x' : 'z', p) using 3:8 with lines lw 1.1 lc rgb experiment
    }
}
unset multiplot
