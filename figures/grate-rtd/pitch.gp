# title: Hold-up and bed height against the pitch of the bars
# counterpart: none; S12 3.9.4 says about 300 particles and 33 mm in words, and nothing of the pitch
# needs: pitches.csv
# caption: Wood at 13.6 kg/h, bars at 35 mm/s. Bands: what the source says, with our tolerance of 10 %. Bars: 95 % intervals. At 87.7 mm (open) the bars lie on each other; those of a smaller pitch are pushed into each other, below those of a larger one is a gap.
width = 17; height = 7.6
load style
set key off
set multiplot layout 1,2 margins screen across(1.7),1 - across(0.3),up(1.65),1 - up(0.4) spacing screen across(1.9),up(1.0)
pitch(touch) = rows('pitches', sprintf('%s($1 > 87 && $1 < 88)', touch ? '' : '!'))
set xrange [70:113]
set xlabel 'pitch (mm)'
do for [k=1:2] {
    if (k > 1) { unset label 999 }
    want = (k == 1 ? 300 : 33)
    value = 2 * k; spread_of = 2 * k + 1
    set yrange [0:(k == 1 ? 650 : 70)]
    set ylabel (k == 1 ? 'bodies on the grate' : 'bed height (mm)')
    set object 1 rect from graph 0,first 0.9 * want to graph 1,first 1.1 * want fc rgb thesis fs transparent solid 0.15 noborder behind
    set arrow 1 from graph 0,first want to graph 1,first want nohead lw 1 lc rgb thesis
    plot pitch(0) using 1:value:(spread(column(spread_of))) with yerrorbars pt 7 ps 0.8 lw 1.1 lc rgb ours, \
         pitch(1) using 1:value:(spread(column(spread_of))) with yerrorbars pt 6 ps 0.9 lw 1.1 lc rgb ours
}
unset multiplot
