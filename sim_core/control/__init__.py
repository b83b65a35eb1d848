"""The controllers behind one interface: passive, LQR, MPC; cost, quadratic programs."""
