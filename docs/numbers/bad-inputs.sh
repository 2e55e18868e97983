# Correctness: how many bad inputs the test tries; it checks itself that its rows are counted right.
sed -n 's/^    {"\([0-9]*\) .*/rows: \1/p' tests/11_bad_input.c | tail -1
