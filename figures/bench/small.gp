# title: Few spheres: cost of a step
# needs: bench-peers.csv
# caption: Microseconds per step, one core; less is better. Bars: 100 and 300 spheres on 11 slowly moving boxes of 12 triangles; LAMMPS has no meshes. Plane: the same spheres piled up on a sliding plane.
width = 12; height = 7.5
load style
load tools.'/bench/machine.gpi'
set style data histograms
set style histogram clustered gap 1.2
set boxwidth 0.92 relative
set xtics scale 0
set xrange [-0.7:3.7]
set bmargin at screen up(1.6)
codes = 'clast/full;clast baseline/full;lammps/full;liggghts/full'
table = sprintf("< awk -v cores=1 -v column=9 -v codes='%s' -v scenes='G100,P100,G300,P300' -f '%s/bench/pivot.awk' '%s/bench-peers.csv'", codes, tools, data)
about(s) = sprintf("%s spheres\n%s", s[2:4], s[1:1] eq 'G' ? 'on moving bars' : 'on a plane')
set ylabel 'µs per step'
set yrange [0:*]
set key top left; set offsets 0, 0, graph 0.05, 0
plot table using 2:xtic(about(strcol(1))) title 'Clast' lc rgb ours, '' using 3 title 'Clast, SSE2' lc rgb ours_light, \
     '' using 4 title 'LAMMPS' lc rgb thesis, '' using 5 title 'LIGGGHTS' lc rgb frictional
