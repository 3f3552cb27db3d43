# title: From empty to steady
# counterpart: none, the source has a first bed laid by hand
# needs: holdup.csv
# caption: Mass between feed and outlet; the runs start empty. Triangles: where the rule (MSER-5) finds the hold-up steady; what was fed before is no tracer.
width = 17; height = 7.6
load style
array name[4] = ['forward clay', 'backward clay', 'backward wood', 'backward ceramic']
array hue[4] = [ours, thesis, frictional, experiment]
part(k) = rows('holdup', sprintf('$1 == "%s"', name[k]))
set lmargin at screen across(1.9)
set xrange [0:*]; set yrange [0:*]
set xlabel 'time (h)'; set ylabel 'hold-up (kg)'
set key outside top center maxrows 1
set tmargin at screen 1 - up(0.9)
plot for [k=1:4] part(k) using ($2 / 60):3 with lines lw 1.1 lc rgb hue[k] title name[k], \
     for [k=1:4] rows('holdup', sprintf('$1 == "%s" && !n++', name[k])) using ($4 / 60):(0.02 * k) with points pt 8 ps 1.3 lw 1.4 lc rgb hue[k]
