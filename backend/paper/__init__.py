"""The paper: its tables against ours, how it can be read, what each part contributes, its figures and errata."""
