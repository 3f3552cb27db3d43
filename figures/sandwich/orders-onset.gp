# title: Orders with an onset
# counterpart: none, our own measurement
# needs: orders.csv slopes.csv
# caption: Error a fifth of a contact after a collision, the largest over eight places of the touch within a step. Behind each name: slope without damping, slope with e = 0.7. Symplectic Euler starts in free flight, where it is the leapfrog. Whatever the order of a scheme, a contact that begins within a step leaves second order where the force has a corner (left) and first order where the dashpot makes it jump (right).
width = 17; height = 11.5
load style
kind_of = 'onset'; lowest = 1e-8; along = 'steps per contact'
load tools.'/sandwich/orders.gpi'
