# title: Wood and ceramic on the backward grate
# counterpart: S12 Figs 4.9 and 4.11
# needs: hard.csv cases.csv
# caption: E(t), samples every three minutes, with the 95 % interval; dashed: first passage with axial dispersion (no fit to ceramic); dotted: tanks in series, both by least squares. Shown to seven mean residence times; a few bodies that lie behind a nose stay longer, of ceramic up to the whole run.
width = 17; height = 7.6
load style
array name[2] = ['backward wood', 'backward ceramic']
array word[2] = ['wood, 40 kg/h', 'ceramic, 60 kg/h']
array hue[2] = [frictional, experiment]
there(k) = system(sprintf("awk -F, '$1 == \"%s\"' '%s/hard.csv' | wc -l", name[k], data)) + 0
mean(k) = system(sprintf("awk -F, '$1 == \"%s\" { print $9 }' '%s/cases.csv'", name[k], data)) + 0
curve(k) = rows('hard', sprintf('$1 == "%s" && $2 == 3', name[k]))
set multiplot layout 1,2 margins screen across(1.8),1 - across(0.3),up(1.65),1 - up(0.4) spacing screen across(1.7),up(1.0)
do for [k=1:2] {
    if (k > 1) { unset label 999 }
    if (there(k)) { set xrange [0:7 * mean(k)]; set yrange [0:*] } else { set xrange [0:1]; set yrange [0:1] }
    set xlabel 'residence time (min)'
    set ylabel (k == 1 ? 'E(t) (1/min)' : '')
    set label 1 '{/:Bold '.word[k].'}' at graph 0.97,0.93 right tc rgb ink
    if (!there(k)) { set label 1 '{/:Bold '.word[k].'}: not run'; plot NaN; continue }
    plot curve(k) using (($3 + $4) / 2):($5 - spread($6)):($5 + spread($6)) with filledcurves fc rgb hue[k] fs transparent solid 0.15 noborder, \
         curve(k) using (($3 + $4) / 2):11 with lines lw 0.9 dt (6,4) lc rgb hue[k], \
         curve(k) using (($3 + $4) / 2):9 with lines lw 0.9 dt (1.5,3) lc rgb hue[k], \
         curve(k) using (($3 + $4) / 2):5 with linespoints pt 7 ps 0.5 lw 1.4 lc rgb hue[k]
}
unset multiplot
