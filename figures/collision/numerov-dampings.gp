# title: Three ways to take Numerov's dashpot
# counterpart: S12 Fig. 3.2
# needs: schemes.csv
# caption: Restitution 0.5, four steps per contact; the velocity of the dashpot as a backward, forward or central difference (S12 3.29 to 3.31).
width = 12; height = 8.5
load style
R = 4; E = 0.5; shown = '14 15 16'
load tools.'/collision/positions.gpi'
