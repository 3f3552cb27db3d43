# title: One collision: error against processor time
# counterpart: none, our own measurement
# needs: points.csv
# caption: Largest of the relative errors of rebound speed, duration and largest overlap. Each mark is a scheme at one number of steps per contact (2, 2.8, 4, ... from the left); errors are root mean squares over the places within a step where the contact can begin. Black: the front, settings that no other one beats in both; an error counts only if no finer step of the scheme has a larger one. The leapfrog is the fast path of the engine, the others are general and slower per step.
width = 17; height = 15
load style
quantity = "largest"; axis = 8; ytitle = "largest of the three errors"
load tools.'/speed-accuracy/collision.gpi'
