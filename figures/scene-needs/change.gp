# title: What changes without each feature
# counterpart: none, the sources have no such study
# needs: needs.csv
# caption: Mean change of the four observables when one feature of the model is left out, paired by seed, with its 95 % interval. Features that a scene does not have are left blank; a cross: without the feature some runs give no value.
width = 17; height = 9.5
load style
load tools.'/scene-needs/needs.gpi'
set multiplot
unset label 999
set datafile separator "\t"
set yrange [11.6:0.4]; set grid xtics noytics; set border 1; unset ytics
set bmargin at screen up(1.75); set tmargin at screen 1 - up(0.9)
# Three to five tics, whatever the range.
end(k, way, column) = number(system(sprintf("%s | awk -F '\t' '$%d != \"NaN\" && %d * $%d > %d * (x + 0) { x = $%d } END { print x + 0 }'", command(k), column, way, column, way, column)))
rounded(f) = f < 1.5 ? 1 : f < 3.5 ? 2 : f < 7.5 ? 5 : 10
unset key
do for [k=1:4] {
    set lmargin at screen across(4.3 + 3.18 * (k - 1)); set rmargin at screen across(6.95 + 3.18 * (k - 1))
    set title sprintf("%s\n%s", scene[k], what[k]) offset 0,-0.4 tc rgb ink
    set xlabel 'change, %'
    low = end(k, -1, 9); high = end(k, 1, 10); span = (high > low ? high - low : 1) / 2.6
    power = 10 ** floor(log10(span)); set xtics rounded(span / power) * power; set xrange [low - 0.2 * span:high + 0.2 * span]
    set arrow 1 from 0, graph 0 to 0, graph 1 nohead lw 0.9 lc rgb experiment back
    if (k == 1) { do for [i=1:11] { set label i name[i] at screen across(0.2), first i left tc rgb ink noenhanced } } else { do for [i=1:11] { unset label i } }
    if (k == 4) { set label 999 stamp at screen 1 - 0.1 / width, 0.18 / height right font small tc rgb faint noenhanced }
    plot table(k) using 8:1:9:10 with xerrorbars pt 7 ps 0.6 lw 1.1 lc rgb ours, \
         table(k) using ($11 > 0 ? 0 : NaN):1 with points pt 2 ps 0.8 lw 1.1 lc rgb faint
}
unset multiplot
