# title: Numerov beside the explicit schemes, without damping
# counterpart: S12 Fig. 3.1
# needs: schemes.csv
# caption: As Fig. 2.25 at four steps per contact, with the implicit Numerov scheme.
width = 12; height = 8.5
load style
R = 4; E = 1; shown = '2 3 4 5 6 16'
load tools.'/collision/positions.gpi'
