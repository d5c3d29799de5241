"""The paper, reproduced and checked: its experiments, its claims, its errors."""
