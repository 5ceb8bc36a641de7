"""The page of runs and sweeps that `lasersph serve` shows in a browser.

folder_list     the runs and sweeps below one folder, each with an address of its own
run_page        content of one run: card, state, numbers, figures, case
study_folder    folders in which a threshold, a convergence or the craters of a spot laid their runs
sweep_page      a sweep or study: its table, the values of its map, its calibration
access          who may ask: token, host names, origin, headers of every answer
server          the addresses, and the loop that answers
case_source     source of the case of a new run: a shipped case, a file, a text, an earlier run
form            a case while it is typed: checks and forecast
changes         changes of a run to its case file
processes       runs that the page starts, stops and resumes; starting: the answers for them
live            events of a run that is computed

The page itself, its style and its modules of JavaScript are sent as they lie here. uplot.js and
uplot.css are uPlot 1.6.32 by Leon Sorokin (MIT license, uplot-license.txt).
"""
