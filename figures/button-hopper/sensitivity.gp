# title: What each assumption does to the rate
# counterpart: none, the source has no such study
# needs: sensitivity.csv
# caption: Change of the steady rate when one assumption is changed, with the 95 % interval of the variant's mean; each block belongs to one orifice, the grey strip is the interval of its baseline. Runs without a rate (blocked, or no linear part) are counted beside the point.
command = sprintf("awk -f '%s/csv.awk' -f '%s/button-hopper/sensitivity.awk' '%s/sensitivity.csv'", tools, tools, data)
field(kind, n, column) = system(sprintf("%s | awk -F '\\t' '$1 == \"%s\" && ++n == %d { print $%d }'", command, kind, n, column))
lines(kind) = system(sprintf("%s | awk -F '\\t' '$1 == \"%s\" { n++ } END { print n + 0 }'", command, kind)) + 0
bottom = system(sprintf("%s | awk -F '\\t' '$1 == \"row\" { n = $6 } END { print n }'", command)) + 0
width = 17; height = 2.1 + 0.56 * bottom
load style
set datafile separator "\t"
table = "< ".command." | grep '^row'"
set lmargin at screen across(8.6); set tmargin at screen 1 - up(0.2)
set xrange [*:*]; set yrange [bottom + 0.6:0.4]
unset ytics; set grid xtics noytics
set border 1
set xlabel 'change of the rate (%)'
do for [k=1:lines('head')] {
    top = number(field('head', k, 3))
    last = k < lines('head') ? number(field('head', k + 1, 3)) - 1.5 : bottom
    base = number(system(sprintf("%s | awk -F '\\t' '$1 == \"row\" && $6 > %g { print $5; exit }'", command, top)))
    set label 50 + k sprintf('{/:Bold D = %s cm}', field('head', k, 2)) at screen across(0.2), first top left tc rgb ink
    set object k rectangle from first -base, first top + 0.5 to first base, first last + 0.5 behind fs solid 1 noborder fc rgb '#ececec'
    set arrow k from first 0, first top + 0.5 to first 0, first last + 0.5 nohead lw 0.9 lc rgb experiment
}
do for [k=1:lines('row')] {
    row = number(field('row', k, 6))
    set label 100 + k field('row', k, 2) at screen across(0.2), first row left tc rgb ink noenhanced
    set label 300 + k field('row', k, 3) at screen across(8.4), first row right tc rgb ink noenhanced
}
plot table using 4:6:5 with xerrorbars pt 7 ps 0.7 lw 1.1 lc rgb ours, \
     table using 4:6 with points pt 7 ps 0.7 lc rgb ours, \
     table using 8:6:7 with labels left offset 0.8,0 font small tc rgb faint noenhanced
