"""The texture of a whole spot, from unit cells of its pattern at the local fluences.

cells      what one run says of a period: relief, depth of the melt, temperature, speed
table      cells over fluence: interpolation, and its error by leaving cells out
lines      heights over places of a line's melt, between its edges in a spot
spot       the maps of a spot, or of several that do not melt what others have molten
make       the plan of the runs, and the files
"""
