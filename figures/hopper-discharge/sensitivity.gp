# title: What each assumption does
# counterpart: none, our own measurement
# needs: sensitivity.csv
# caption: One assumption changed at a time; bars are 95 % intervals over the initial states, wide where there are two, and cut at the frame. Left: mean residence time at 0.2 ms. Middle: by how much it drifts up to 0.8 ms. Right: the step at which a run stops, to 0.1 ms.
width = 17; height = 9.7
load style
load tools.'/hopper-discharge/discharge.gpi'
set multiplot
all = sprintf("< sed '1d; s/\"walls, from the vertical\"/walls to the vertical/; s/\"rectangular, flat bottom\"/flat bottom/' '%s/sensitivity.csv'", data)
set yrange [-9.6:0.6]; set grid noytics xtics
row(n) = -n
set tmargin at screen 1 - up(1.2)
set key at screen 0.62,1 - up(0.1) center top maxrows 1
set lmargin at screen across(5.2); set rmargin at screen across(8.7)
set xlabel 'residence time, s'; set xrange [0.4:1.35]; set xtics 0.2
plot all using 4:(row($0)):(spread($5)):ytic(strcol(1).(strcol(2) eq '' ? '' : ': '.strcol(2))) with xerrorbars pt 5 ps 0.8 lw 1.1 lc rgb tints[2] notitle
unset label 999; unset ytics
set lmargin at screen across(9.2); set rmargin at screen across(12.7)
set xlabel 'drift up to 0.8 ms, %'; set xrange [-12:12]; set xtics 5
plot all using (100 * $6):(row($0) + 0.12):(100 * spread($7)) with xerrorbars pt marks[2] ps 0.8 lw 1.1 lc rgb tints[2] title words[2], \
     all using (100 * $8):(row($0) - 0.12):(100 * spread($9)) with xerrorbars pt marks[3] ps 0.8 lw 1.1 lc rgb tints[3] title words[3]
unset key
set lmargin at screen across(13.2); set rmargin at screen across(16.7)
set xlabel 'run stops at, ms'; set xrange [1.2:2]; set xtics 0.2
plot all using (1e3 * $14):(row($0) + 0.12):(1e3 * spread($15)) with xerrorbars pt marks[2] ps 0.8 lw 1.1 lc rgb tints[2], \
     all using (1e3 * $16):(row($0) - 0.12):(1e3 * spread($17)) with xerrorbars pt marks[3] ps 0.8 lw 1.1 lc rgb tints[3], \
     all using (1.6):(row($0)):(number(strcol(14)) < 1.01e-4 ? 'at any step' : '') with labels font small tc rgb ink
unset multiplot
