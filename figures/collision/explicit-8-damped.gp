# title: Explicit schemes, 8 steps per contact, restitution 0.5
# counterpart: S12 Figs 2.30 and 2.31
# needs: schemes.csv
# caption: Linear spring-dashpot, one ball against a wall, the touch on a step. Velocity over that of the impact, positions as overlap over the largest without damping. Position Verlet's velocity is that of S12 2.68, one step behind; symplectic Euler passes the positions of velocity Verlet, as does position Verlet without damping: one mark hides the other. The dashpot is that of S12 2.21, which with the cut-off rebounds with more than 0.5; the line is the exact solution for it.
width = 17; height = 8.5
load style
R = 8; E = 0.5
load tools.'/collision/explicit.gpi'
