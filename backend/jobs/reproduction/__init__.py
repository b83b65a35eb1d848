"""The paper, checked: its tables against ours, what each part contributes, its figures."""
