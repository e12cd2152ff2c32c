# as ORIPA writes it: a corner of four folds, and a line that is not folded
1 -200 -200 200 -200
1 200 -200 200 200
1 200 200 -200 200
1 -200 200 -200 -200
3 0 0 100 -200
3 0 0 100 200
3 -200 0 0 0
2 0 0 200 0
4 -200 -200 0 0
