/* x[i + 1] = M x[i] + f[i]. */

/* matrix  M (n x n)
   states  (steps + 1) x n: the first row is x[0]; row i + 1 holds f[i] and becomes x[i + 1] */
void ridelab_recurrence(const double *restrict matrix, int n, int steps, double *restrict states)
{
    for (int step = 0; step < steps; step++, states += n)
        for (int i = 0; i < n; i++) {
            double next = states[n + i];
            for (int j = 0; j < n; j++)
                next += matrix[n * i + j] * states[j];
            states[n + i] = next;
        }
}
