# title: What each assumption does to the rate
# counterpart: none, the source has no such study
# needs: sensitivity.csv
# caption: Change of the steady rate when one assumption is changed, with the 95 % interval of the variant's mean; the grey strip is that of the baseline. Runs that blocked have no rate: they are counted in brackets.
width = 17; height = 12.5
load style
command = sprintf("awk -f '%s/button-hopper/sensitivity.awk' '%s/sensitivity.csv'", tools, data)
table = '< '.command   # assumption, variant, change, half, row
set datafile separator "\t"
entry(row, column) = system(sprintf("%s | awk -F '\\t' 'NR == %d { print $%d }'", command, row, column))
D = system(sprintf("awk -F, 'NR == 2 { print $4 }' '%s/sensitivity.csv'", data))
stats table using 5 nooutput
count = STATS_max
base = number(entry(1, 4))
set lmargin at screen across(8.6); set tmargin at screen 1 - up(0.2)
set xrange [*:*]; set yrange [count + 0.6:0.4]
unset ytics; set grid xtics noytics
set border 1
set xlabel sprintf('change of the rate at D = %s cm (%%)', D)
set object 1 rectangle from first -base, first 0.4 to first base, first count + 0.6 behind fs solid 1 noborder fc rgb '#ececec'
set arrow 1 from first 0, graph 0 to first 0, graph 1 nohead lw 0.9 lc rgb experiment
do for [k=1:count] {
    set label 100 + k entry(k, 1) at screen across(0.2), first k left tc rgb ink noenhanced
    set label 200 + k entry(k, 2) at screen across(8.4), first k right tc rgb ink noenhanced
}
plot table using 3:5:4 with xerrorbars pt 7 ps 0.7 lw 1.1 lc rgb ours, \
     table using 3:5 with points pt 7 ps 0.7 lc rgb ours
