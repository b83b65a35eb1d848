"""The reproduction: the paper's tables against ours, what each part contributes, its figures."""
