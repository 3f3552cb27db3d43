# title: One collision: duration
# counterpart: none, our own measurement
# needs: points.csv
# caption: Relative error of the time from the touch until the overlap would be zero again. Each mark is a scheme at one number of steps per contact (2, 2.8, 4, ... from the left); errors are root mean squares over the places within a step where the contact can begin. Black: the front, settings that no other one beats in both; an error counts only if no finer step of the scheme has a larger one.
width = 17; height = 15
load style
quantity = "duration"; axis = 11; ytitle = "error of the duration"
load tools.'/speed-accuracy/collision.gpi'
