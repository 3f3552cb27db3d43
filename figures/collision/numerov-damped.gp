# title: Numerov with the central difference beside the explicit schemes
# counterpart: S12 Fig. 3.3
# needs: schemes.csv
# caption: Restitution 0.5, four steps per contact.
width = 12; height = 8.5
load style
R = 4; E = 0.5; shown = '2 3 4 5 6 16'
load tools.'/collision/positions.gpi'
